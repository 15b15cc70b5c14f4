#include "oscillators.hpp"

#include <cmath>

#include "base/errors.hpp"
#include "scene/describer.hpp"

namespace ejecta {

namespace {

/// What one of them does at the start.
struct Kick {
  std::string name, origin;
  std::int64_t oscillator = 1;
  double velocity = unset;
};

struct Settings final : SectionSettings {
  std::int64_t count = 3;
  double mass = 1, period = 1, amplitude = 1, damping = 0;
  std::vector<Kick> kicks;
  void describe(Describer& d) override {
    d.integer("count", count, at_least(1), "how many; the k-th is k times as stiff");
    d.number("mass", mass, "kg", positive, "of each");
    d.number("period", period, "s", positive, "of the first");
    d.number("amplitude", amplitude, "m", positive, "at the start");
    d.number("damping", damping, "kg/s", non_negative, "force over velocity");
    d.list("kicks", kicks, false, "an oscillator that moves at the start", [&](Kick& kick) {
      d.text("name", kick.name, "how --set calls it");
      d.integer("oscillator", kick.oscillator, at_least(1), "which, from 1");
      d.number("velocity", kick.velocity, "m/s", any_number, "that it has").required = true;
      d.origin(kick.origin);
    });
  }
};

/// Implicit midpoint rule: m dv/dt = -k x - c v loses from motion and spring just the heat c v^2 dt.
class Oscillators final : public Package {
 public:
  explicit Oscillators(const Settings& settings) : s_(settings), x_(n(), s_.amplitude), v_(n(), 0), heat_(n(), 0) {
    for (const Kick& kick : s_.kicks) {
      if (kick.oscillator > s_.count)
        throw InputError(kick.origin + ": oscillators.kicks.oscillator: expected one of " + std::to_string(s_.count));
      v_[static_cast<std::size_t>(kick.oscillator - 1)] = kick.velocity;
    }
    initial = conserved();
  }
  std::string_view name() const override { return "oscillators"; }
  Vote vote() override { return {100 * own_step(), "oscillators", 0}; }
  void advance(double dt) override {
    const auto steps = static_cast<std::int64_t>(std::ceil(dt / own_step()));
    for (std::int64_t k = 0; k < steps; ++k) substep(dt / static_cast<double>(steps));
  }
  void check_health() const override {}
  Totals conserved() const override {
    Totals t;
    for (std::size_t i = 0; i < n(); ++i) {
      t.mass += s_.mass;
      t.momentum[0] += s_.mass * v_[i];
      t.momentum_scale += s_.mass * std::abs(v_[i]);
      t.kinetic += 0.5 * s_.mass * v_[i] * v_[i];
      t.internal += 0.5 * stiffness(i) * x_[i] * x_[i] + heat_[i];
    }
    return t;
  }
  void persist(Archive& archive) override {
    archive.size(n());
    archive.column("displacement", "m", x_);
    archive.column("velocity", "m/s", v_);
    archive.column("heat", "J", heat_);
  }
  Quantities quantities() const override { return {{"displacement", "m", x_[0], "of the first oscillator", true}}; }
  bool is_loaded() const override { return true; }  // by the anchors
  std::vector<std::string> channel_names() const override { return {"oscillators"}; }
  std::vector<Channel> channels(const Asked& asked) const override {
    if (!asked("oscillators")) return {};
    Channel channel{.name = "oscillators", .count = n(), .position = {x_, v_, heat_}, .fields = {}, .indices = {}};
    channel.fields.push_back({"displacement", "m", {x_}});
    return {channel};
  }
  std::string describe(std::size_t i) const override { return "oscillator " + std::to_string(i); }
  std::size_t elements() const override { return n(); }
  std::size_t bytes() const override { return 3 * n() * sizeof(double); }

 private:
  std::size_t n() const { return static_cast<std::size_t>(s_.count); }
  double stiffness(std::size_t i) const {
    const double omega = 2 * M_PI / s_.period;
    return static_cast<double>(i + 1) * s_.mass * omega * omega;
  }
  double own_step() const { return 0.01 * s_.period / std::sqrt(static_cast<double>(n())); }
  void substep(double dt) {
    for (std::size_t i = 0; i < n(); ++i) {
      const double k = stiffness(i), c = s_.damping, m = s_.mass;
      const double mean_v = (m * v_[i] - 0.5 * dt * k * x_[i]) / (m + 0.5 * dt * c + 0.25 * dt * dt * k);
      external.impulse[0] -= dt * (k * (x_[i] + 0.5 * dt * mean_v) + c * mean_v);  // by the anchor
      heat_[i] += dt * c * mean_v * mean_v;
      x_[i] += dt * mean_v;
      v_[i] = 2 * mean_v - v_[i];
    }
    clock = {clock.time + dt, dt, clock.step + 1};
  }

  Settings s_;
  std::vector<double> x_, v_, heat_;
};

}  // namespace

PackageKind oscillators() {
  return {{"oscillators", "damped oscillators on anchored springs", [] { return std::make_shared<Settings>(); }},
          [](const Scene& scene, const std::vector<Material>&) -> std::unique_ptr<Package> {
            return std::make_unique<Oscillators>(dynamic_cast<const Settings&>(*scene.sections.at("oscillators")));
          },
          {{"displacement", "m"}}};
}

}  // namespace ejecta
