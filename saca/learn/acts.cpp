#include "saca/learn/acts.h"

namespace saca::learn {
namespace {

std::size_t age_of(std::size_t frames) {
  constexpr double rounding = 1e-9;
  const double age = static_cast<double>(frames) * frame_step + rounding;
  std::size_t k = 0;
  while (k + 1 < ActsFound::ages.size() && age >= ActsFound::ages[k + 1]) {
    ++k;
  }
  return k;
}

void count(ActsFound::Share& share, bool is_found) {
  ++share.num;
  share.found += is_found ? 1U : 0U;
}

void add(ActsFound::Share& to, const ActsFound::Share& more) {
  to.num += more.num;
  to.found += more.found;
}

}  // namespace

std::optional<double> ActsFound::Share::share() const {
  return num == 0 ? std::nullopt
                  : std::optional(static_cast<double>(found) / static_cast<double>(num));
}

ActsFound& ActsFound::operator+=(const ActsFound& other) {
  for (std::size_t c = 0; c < num_vehicle_classes; ++c) {
    add(of[c].acts, other.of[c].acts);
    for (std::size_t k = 0; k < ages.size(); ++k) {
      add(of[c].frames[k], other.of[c].frames[k]);
    }
  }
  return *this;
}

ActsFound acts_found(const Sequence& sequence, const Forecasts& forecasts) {
  expect_whole(sequence);
  expect_forecasts_of(sequence, forecasts);
  ActsFound found;
  const auto& labels = sequence.labels;
  for (std::size_t first = 0; first < labels.size();) {
    const std::uint8_t act = labels[first];
    bool is_scored = false;
    bool is_found = false;
    std::size_t t = first;
    for (; t < labels.size() && labels[t] == act; ++t) {
      if (act != 0 && sequence.scored[t]) {
        const bool is_right = forecasts.named(0, t) == act;
        count(found.of[act].frames[age_of(t - first)], is_right);
        is_scored = true;
        is_found = is_found || is_right;
      }
    }
    if (is_scored) {
      count(found.of[act].acts, is_found);
    }
    first = t;
  }
  return found;
}

}  // namespace saca::learn
