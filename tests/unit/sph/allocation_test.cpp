/// Counts allocations: the global operator new of this test program.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "unit/sph/small_scenes.hpp"

namespace {
std::atomic<long> allocations{0};

void* counted(std::size_t size, std::size_t alignment) {
  ++allocations;
  const std::size_t rounded = (std::max<std::size_t>(size, 1) + alignment - 1) / alignment * alignment;
  if (void* memory = std::aligned_alloc(alignment, rounded)) return memory;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) { return counted(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t a) { return counted(size, static_cast<std::size_t>(a)); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace ejecta {
namespace {

struct Counts {
  long without_new_lists = 0, with_new_lists = 0;
  int steps = 0;
  long builds = 0, sorts = 0;
};

/// Allocations during the steps after the first 40.
template <int Dim>
Counts count_allocations(Sph<Dim>& sim) {
  advance(sim, 40);
  Counts counts;
  const auto sorts_before = sim.sorts;
  for (; counts.steps < 100; ++counts.steps) {
    const auto builds = sim.list_builds;
    const long before = allocations;
    step(sim, no_limit);
    const long made = allocations - before;
    (sim.list_builds == builds ? counts.without_new_lists : counts.with_new_lists) += made;
    counts.builds += sim.list_builds != builds;
  }
  counts.sorts = sim.sorts - sorts_before;
  return counts;
}

TEST(Allocation, TheCounterCounts) {
  const long before = allocations;
  std::vector<double> numbers(10);
  EXPECT_EQ(allocations - before, 1);
}

TEST(Allocation, StepsAllocateNothingOnceWarm) {
  for (const char* precision : {"numerics.precision=double", "numerics.precision=mixed"}) {
    const Counts rock = count_allocations(*start<3>(porous_impact, {precision, "bodies.ball.material=rubber"}));
    const Counts gas = count_allocations(*start<2>(gas_tube, {precision}));
    EXPECT_EQ(rock.without_new_lists, 0) << precision;
    EXPECT_EQ(gas.without_new_lists, 0) << precision;
    // Lists grow now and then as matter spreads, and a new order of the particles needs a few dozen small blocks.
    EXPECT_LE(rock.with_new_lists, rock.builds + 60 * rock.sorts) << precision;
    EXPECT_LE(gas.with_new_lists, gas.builds + 60 * gas.sorts) << precision;
    EXPECT_LT(rock.builds, rock.steps / 2);
    EXPECT_LT(gas.builds, gas.steps / 2);
  }
}

}  // namespace
}  // namespace ejecta
