#include "saca/lab/intention_scoring/manoeuvre_events.h"

namespace saca::intention_scoring {
namespace {

std::size_t age_of(std::size_t frames) {
  constexpr double rounding = 1e-9;
  const double age = static_cast<double>(frames) * frame_step + rounding;
  std::size_t k = 0;
  while (k + 1 < ManoeuvreEventsFound::ages.size() && age >= ManoeuvreEventsFound::ages[k + 1]) {
    ++k;
  }
  return k;
}

void count(ManoeuvreEventsFound::Share& share, bool is_found) {
  ++share.num;
  share.found += is_found ? 1U : 0U;
}

void add(ManoeuvreEventsFound::Share& to, const ManoeuvreEventsFound::Share& more) {
  to.num += more.num;
  to.found += more.found;
}

}  // namespace

std::optional<double> ManoeuvreEventsFound::Share::share() const {
  return num == 0 ? std::nullopt
                  : std::optional(static_cast<double>(found) / static_cast<double>(num));
}

ManoeuvreEventsFound& ManoeuvreEventsFound::operator+=(const ManoeuvreEventsFound& other) {
  for (std::size_t c = 0; c < num_vehicle_classes; ++c) {
    add(of[c].events, other.of[c].events);
    for (std::size_t k = 0; k < ages.size(); ++k) {
      add(of[c].frames[k], other.of[c].frames[k]);
    }
  }
  return *this;
}

ManoeuvreEventsFound manoeuvre_events_found(const Sequence& sequence, const Forecasts& forecasts) {
  expect_whole(sequence);
  expect_forecasts_of(sequence, forecasts);
  ManoeuvreEventsFound found;
  const auto& labels = sequence.labels;
  for (std::size_t first = 0; first < labels.size();) {
    const std::uint8_t event = labels[first];
    bool is_scored = false;
    bool is_found = false;
    std::size_t t = first;
    for (; t < labels.size() && labels[t] == event; ++t) {
      if (event != 0 && sequence.scored[t]) {
        const bool is_right = forecasts.named(0, t) == event;
        count(found.of[event].frames[age_of(t - first)], is_right);
        is_scored = true;
        is_found = is_found || is_right;
      }
    }
    if (is_scored) {
      count(found.of[event].events, is_found);
    }
    first = t;
  }
  return found;
}

}  // namespace saca::intention_scoring
