#include "saca/thinking/rollout/batch.h"

#include <benchmark/benchmark.h>

#include "saca/lab/prepare/shipped_cars_for_test.h"

namespace saca::rollout {
namespace {

constexpr double bench_horizon = 5.0;  // [s]

// All policies from 12 to 19 m/s at grips of 0.65 to 0.93: 64 scenes.
std::vector<Drive> bench_drives(const manoeuvre::Car& car) {
  std::vector<Drive> drives;
  for (int i = 0; i < 64; ++i) {
    const double speed = 12.0 + i % 8;
    const int row = i / 8;
    const double grip = 0.65 + 0.04 * row;
    for (const manoeuvre::PolicyId policy : manoeuvre::all_policies) {
      Drive drive{.car = &car, .plan = manoeuvre::default_plan(policy, speed)};
      drive.ego.v_B = {speed, 0.0};
      drive.known_grip = grip;
      drive.grip = grip;
      drives.push_back(drive);
    }
  }
  return drives;
}

// Items are scenes: eight policies, driven until they end or for 5 s.
template <class Work>
void bench_batch(benchmark::State& bench, const Work& work) {
  const auto level = static_cast<SimdLevel>(bench.range(0));
  if (!available(level)) {
    bench.SkipWithError("not this processor's");
    return;
  }
  const manoeuvre::Car car = prepare::default_car();
  const std::vector<Drive> drives = bench_drives(car);
  std::size_t poses = 0;
  for (auto _ : bench) {
    poses += work(drives, level);
  }
  bench.SetItemsProcessed(bench.iterations() * 64);
  bench.counters["s_per_scene"] =
      0.01 * static_cast<double>(poses) / (64.0 * static_cast<double>(bench.iterations()));
}

std::size_t num_poses(const std::vector<manoeuvre::EgoMotion>& motions) {
  std::size_t poses = 0;
  for (const manoeuvre::EgoMotion& motion : motions) {
    poses += motion.v_B.size();
  }
  return poses;
}

void batch_scenes(benchmark::State& bench) {
  bench_batch(bench, [](const std::vector<Drive>& drives, SimdLevel level) {
    return num_poses(drive_all(drives, bench_horizon, 1, level));
  });
}
BENCHMARK(batch_scenes)->DenseRange(0, 2);

// The same into memory that is used again.
void batch_scenes_in_a_row(benchmark::State& bench) {
  std::vector<manoeuvre::EgoMotion> motions;
  bench_batch(bench, [&](const std::vector<Drive>& drives, SimdLevel level) {
    drive_all(drives, bench_horizon, motions, 1, level);
    return num_poses(motions);
  });
}
BENCHMARK(batch_scenes_in_a_row)->DenseRange(0, 2);

void scalar_scenes(benchmark::State& bench) {
  const manoeuvre::Car car = prepare::default_car();
  const std::vector<Drive> drives = bench_drives(car);
  for (auto _ : bench) {
    for (std::size_t i = 0; i < 64; i += 8) {
      for (std::size_t k = 0; k < 8; ++k) {
        const Drive& one = drives[8 * i + k];
        benchmark::DoNotOptimize(
            manoeuvre::drive(car, one.plan, scene_of(one), one.grip, bench_horizon));
      }
    }
  }
  bench.SetItemsProcessed(bench.iterations() * 8);
}
BENCHMARK(scalar_scenes);

}  // namespace
}  // namespace saca::rollout
