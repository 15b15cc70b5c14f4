#pragma once
/// What every benchmark reports: items per second, and the share of the peak that bounds it.
#include <benchmark/benchmark.h>

#include "performance/peak.hpp"

namespace ejecta {

/// One benchmark: runs it, then reports on it. Rates and shares are per second of processor time.
class Measurement {
 public:
  explicit Measurement(benchmark::State& state) : state_(state) {}

  template <class Body>
  void run(Body&& body) {
    run(body, [] {});
  }
  /// Calls prepare() before each body(), outside what is timed.
  template <class Body, class Prepare>
  void run(Body&& body, Prepare&& prepare) {
    for (auto _ : state_) {
      state_.PauseTiming();
      prepare();
      const double start = processor_seconds();
      state_.ResumeTiming();
      body();
      seconds_ += processor_seconds() - start;
    }
  }

  /// items_per_second, for the items handled by one body().
  void items(double n) { state_.SetItemsProcessed(state_.iterations() * static_cast<std::int64_t>(n)); }
  /// flops_share: operations per second over those of a loop of fused multiply-adds in precision T.
  template <class T>
  void flops(double per_body) {
    state_.counters["flops_share"] = per_second(per_body) / peak_flops<T>();
  }
  /// bandwidth_share: bytes that must at least be read and written, per second, over those of a copy of memory.
  void bytes(double per_body) { state_.counters["bandwidth_share"] = per_second(per_body) / peak_bandwidth(); }
  void counter(const char* name, double value) { state_.counters[name] = value; }

 private:
  double per_second(double per_body) const { return per_body * static_cast<double>(state_.iterations()) / seconds_; }
  benchmark::State& state_;
  double seconds_ = 0;
};

}  // namespace ejecta
