#pragma once
/// What a description is good for: reading and checking a document, echoing the values, printing the reference.
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/describer.hpp"
#include "scene/document.hpp"

namespace ejecta {

/// All that is wrong with what the user wrote, thrown together and in the order of the lines.
class Problems {
 public:
  void add(const Origin& origin, const std::string& path, std::string_view message);
  /// Takes over the messages of an error met elsewhere.
  void add(const std::vector<std::string>& messages);
  bool has(const std::string& path) const { return paths_.contains(path); }
  bool empty() const { return messages_.empty(); }
  /// Throws InputError if there is any.
  void throw_if_any() const;

 private:
  std::vector<std::pair<int, std::string>> messages_;  ///< line, text
  std::set<std::string> paths_;
};

/// Sets every described value the document gives, checks type, unit and range, and refuses what is not described.
void read_settings(const Describer& description, const Document& document, Problems& problems);

/// Every value as TOML in SI, with its meaning in a comment. Values that are not set appear as a comment only.
std::string write_toml(const Describer& description);

/// Every key with its unit, range, default and meaning. With a name only that section and those inside it; empty if
/// there is none.
std::string write_reference(const Describer& description, std::string_view section = "");

/// The candidate nearest to a misspelt word, or "" if none is near. Distance: insertions, deletions, replacements and
/// swaps of neighbours.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace ejecta
