#include "saca/lab/learned_danger/experience.h"

#include <algorithm>
#include <array>

#include "saca/base/core/contract.h"

namespace saca::learned_danger {
namespace {

Observation row_of(const std::vector<float>& rows, std::size_t i) {
  Observation one{};
  std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(i * num_features), num_features,
              one.begin());
  return one;
}

float told_of(float h) {
  return static_cast<float>(told(static_cast<double>(h)));
}

void add_state(Experience& all, const Observation& seen, const world::Footprint& body,
               world::Shape shape) {
  for (std::size_t k = 0; k < all.num_obstacles; ++k) {
    const SeenByNet one = seen_by_net(body, seen, k, shape);
    all.inputs.insert(all.inputs.end(), one.inputs.begin(), one.inputs.end());
    all.h_at.push_back(static_cast<float>(told(one.h)));
  }
}

/// Transitions from `first` until before `last`, which are one situation.
void add_situation(Experience& all, const Transitions& from, std::size_t first, std::size_t last,
                   const world::Footprint& body, world::Shape shape) {
  const std::size_t start = all.size();
  for (std::size_t i = first; i < last; ++i) {
    all.row.push_back(static_cast<std::uint32_t>(all.num_states()));
    all.next_row.push_back(all.row.back() + 1);
    add_state(all, row_of(from.observations, i), body, shape);
    all.actions.insert(all.actions.end(), {from.actions[2 * i], from.actions[2 * i + 1]});
    all.h.push_back(told_of(from.h[i]));
    all.settled.push_back(from.settled[i]);
  }
  add_state(all, row_of(from.next_observations, last - 1), body, shape);
  all.reached.resize(all.size());
  const float after_last =
      from.settled[last - 1] != 0.0F ? told_of(from.next_h[last - 1]) : Experience::end_not_seen;
  constexpr auto horizon = static_cast<std::size_t>(horizon_looks);
  for (std::size_t i = start; i < all.size(); ++i) {
    const std::size_t until = std::min(all.size(), i + horizon);
    const float deepest = *std::max_element(all.h.begin() + static_cast<std::ptrdiff_t>(i),
                                            all.h.begin() + static_cast<std::ptrdiff_t>(until));
    all.reached[i] = i + horizon > all.size() ? std::max(deepest, after_last) : deepest;
  }
}

}  // namespace

void add_experience(Experience& all, const Transitions& transitions, const world::Footprint& body,
                    world::Shape shape) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < transitions.size(); ++i) {
    if (transitions.settled[i] == 0.0F && transitions.cut_off[i] == 0.0F) {
      continue;
    }
    if (num_obstacles_of(row_of(transitions.observations, first)) == all.num_obstacles) {
      add_situation(all, transitions, first, i + 1, body, shape);
    }
    first = i + 1;
  }
}

void keep_held(Experience& all, int looks) {
  expects(looks >= 1, "a look or more");
  const std::size_t before = all.size();
  const auto wanted = static_cast<std::size_t>(looks);
  const auto goes_on = [&](std::size_t i) {
    return i + 1 < before && all.row[i + 1] == all.next_row[i] &&
           all.actions[2 * i + 2] == all.actions[2 * i] &&
           all.actions[2 * i + 3] == all.actions[2 * i + 1];
  };
  std::size_t kept = 0;
  for (std::size_t i = 0; i < before; ++i) {
    std::size_t last = i;
    float h = all.h[i];
    while (last + 1 - i < wanted && goes_on(last)) {
      h = std::max(h, all.h[++last]);
    }
    if (last + 1 - i < wanted && all.settled[last] == 0.0F) {
      continue;
    }
    all.row[kept] = all.row[i];
    all.next_row[kept] = all.next_row[last];
    all.actions[2 * kept] = all.actions[2 * i];
    all.actions[2 * kept + 1] = all.actions[2 * i + 1];
    all.h[kept] = h;
    all.settled[kept] = all.settled[last];
    all.reached[kept] = all.reached[i];
    ++kept;
  }
  all.actions.resize(2 * kept);
  for (auto* each : {&all.row, &all.next_row}) {
    each->resize(kept);
  }
  for (auto* each : {&all.h, &all.settled, &all.reached}) {
    each->resize(kept);
  }
}

}  // namespace saca::learned_danger
