#include "saca/thinking/memory/store.h"

#include <benchmark/benchmark.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "saca/onboard/match/example_scenes.h"

namespace saca::memory::store_bench {
namespace {

namespace fs = std::filesystem;

/// A file of its own for one benchmark.
class Bank {
 public:
  Bank() : path_(fs::temp_directory_path() / ("saca_bank_" + std::to_string(::getpid()) + ".db")) {
    fs::remove(path_);
  }
  ~Bank() { fs::remove(path_); }
  Bank(const Bank&) = delete;
  Bank& operator=(const Bank&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

Case case_of(std::mt19937& rng) {
  Case one;
  one.scene = match::random_scene(rng, static_cast<int>(rng() % 9));
  return one;
}

// To the disk and back, per case: no more than a few per minute are ever added.
void add_one_case(benchmark::State& state) {
  const Bank bank;
  Store store = Store::open(bank.path()).value();
  std::mt19937 rng(1);
  const Case one = case_of(rng);
  for (auto _ : state) {
    benchmark::DoNotOptimize(store.add(one).has_value());
  }
}
BENCHMARK(add_one_case)->Unit(benchmark::kMillisecond);

// The same on a server (SACA_POSTGRES_URL), also by several at once, each with its own connection.
void add_one_case_to_a_server(benchmark::State& state) {
  const char* const url = std::getenv("SACA_POSTGRES_URL");
  if (url == nullptr) {
    state.SkipWithError("SACA_POSTGRES_URL names no server");
    return;
  }
  Store store = Store::open(url).value();
  std::mt19937 rng(1);
  const Case one = case_of(rng);
  for (auto _ : state) {
    benchmark::DoNotOptimize(store.add(one).has_value());
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(add_one_case_to_a_server)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->ThreadRange(1, 4);

void nearest_of(benchmark::State& state) {
  const Bank bank;
  Store store = Store::open(bank.path()).value();
  std::mt19937 rng(2);
  for (int i = 0; i < state.range(0); ++i) {
    if (!store.add(case_of(rng)).has_value()) {
      state.SkipWithError("the disk is full");
      return;
    }
  }
  for (auto _ : state) {
    const world::Scene scene = match::random_scene(rng, static_cast<int>(rng() % 9));
    benchmark::DoNotOptimize(store.recall(scene).has_value());
  }
}
BENCHMARK(nearest_of)->Arg(100)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace saca::memory::store_bench
