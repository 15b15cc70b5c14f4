#include "scene/describer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "scene/units.hpp"

namespace ejecta {

std::string to_text(const Limits& limits, std::string_view si_unit) {
  const auto text = [&](double bound) { return bound == 0 ? std::string("0") : format_quantity(bound, si_unit); };
  if (std::isfinite(limits.min) && std::isfinite(limits.max))
    return fmt::format("from {} to {}", text(limits.min), text(limits.max));
  if (std::isfinite(limits.min)) return fmt::format("{} {}", limits.open_min ? ">" : ">=", text(limits.min));
  if (std::isfinite(limits.max)) return fmt::format("<= {}", text(limits.max));
  return "";
}

Describer Describer::of_all_there_may_be() {
  Describer describer;
  describer.all_there_may_be_ = true;
  return describer;
}

void Describer::section(const std::string& name, std::string doc) {
  place_.section = path_of(name);
  sections_.push_back({place_.section, std::move(doc)});
}

void Describer::origin(std::string& text) const {
  if (document_) text = document_->origin(place_.section).text;
}

std::string Describer::path_of(const std::string& name) const {
  return place_.around.empty() ? name : place_.around + "." + name;
}

std::size_t Describer::length_of_list(const std::string& name, bool needed, std::size_t present) {
  lists_.push_back({path_of(name), needed});
  return document_ ? document_->count(path_of(name)) : all_there_may_be_ ? 1 : present;
}

std::vector<std::string> Describer::keys_of_map(const std::string& name, const std::string& any_key) const {
  if (document_) return document_->children(path_of(name));
  return all_there_may_be_ ? std::vector{any_key} : std::vector<std::string>{};
}

Setting& Describer::add(std::string key, Target target, std::string unit, Limits limits, std::string doc) {
  settings_.push_back({place_.section, std::move(key), std::move(target), std::move(unit), limits, std::move(doc)});
  return settings_.back();
}

Setting& Describer::number(std::string key, double& value, std::string unit, Limits limits, std::string doc) {
  return add(std::move(key), &value, std::move(unit), limits, std::move(doc));
}
Setting& Describer::triple(std::string key, Triple& value, std::string unit, std::string doc) {
  return add(std::move(key), &value, std::move(unit), any_number, std::move(doc));
}
Setting& Describer::range(std::string key, ColourRange& value, std::string doc) {
  return add(std::move(key), &value, "any", any_number, std::move(doc));
}
Setting& Describer::flag(std::string key, bool& value, std::string doc) {
  return add(std::move(key), &value, "", any_number, std::move(doc));
}
Setting& Describer::integer(std::string key, std::uint64_t& value, std::string doc) {
  return add(std::move(key), &value, "1", non_negative, std::move(doc));
}
Setting& Describer::text(std::string key, std::string& value, std::string doc) {
  return add(std::move(key), &value, "", any_number, std::move(doc));
}
Setting& Describer::texts(std::string key, std::vector<std::string>& values, std::string doc) {
  return add(std::move(key), &values, "", any_number, std::move(doc));
}
Setting& Describer::numbers(std::string key, std::vector<double>& values, std::string unit, Limits limits,
                            std::string doc) {
  return add(std::move(key), &values, std::move(unit), limits, std::move(doc));
}
Setting& Describer::frame_times(std::string key, FrameTimes& value, std::string doc) {
  return add(std::move(key), &value, "s", non_negative, std::move(doc));
}
Setting& Describer::chosen(std::string key, std::string word, std::vector<std::string> words, std::string doc) {
  Choice choice{std::move(words), [word = std::move(word)] { return word; }, [](std::size_t) {}};
  return add(std::move(key), std::move(choice), "", any_number, std::move(doc));
}

}  // namespace ejecta
