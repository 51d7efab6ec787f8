#include "saca/memory/feature_index.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saca/core/contract.h"

namespace saca::memory {
namespace {

constexpr auto infinity = std::numeric_limits<double>::infinity();

/// Equal steps of a quantity; the first begins and the last ends at infinity.
struct Steps {
  double low = 0.0;    ///< where the second begins
  double width = 1.0;  ///< of a step
  int count = 1;

  [[nodiscard]] int of(double value) const {
    return std::clamp(1 + static_cast<int>(std::floor((value - low) / width)), 0, count - 1);
  }
  /// Least distance from a value to what lies in a step.
  [[nodiscard]] double gap(double value, int step) const {
    const double from = step == 0 ? -infinity : low + width * (step - 1);
    const double to = step == count - 1 ? infinity : low + width * step;
    return std::max({from - value, value - to, 0.0});
  }
};

constexpr double squared(double x) {
  return x * x;
}

/// Smaller differences first, of equals the older.
bool nearer(const FeatureIndex::Hit& a, const FeatureIndex::Hit& b) {
  return a.difference != b.difference ? a.difference < b.difference : a.id < b.id;
}

// As wide as a difference of 1.
constexpr Steps speeds{-5.0, speed_scale, 96};
constexpr Steps grips{-3.2, log_grip_scale, 24};

}  // namespace

std::size_t FeatureIndex::cell_at(int speed, int grip) noexcept {
  return static_cast<std::size_t>(speed) * num_grips + static_cast<std::size_t>(grip);
}

std::size_t FeatureIndex::cell_of(const EgoFeatures& ego) noexcept {
  static_assert(speeds.count == num_speeds && grips.count == num_grips);
  return cell_at(speeds.of(ego.v_L.x), grips.of(ego.log_grip));
}

void FeatureIndex::add(CaseId id, const world::Scene& scene) {
  expects(id > last_id(), "id > last_id()");
  const Features known = features(scene);
  expects(known.ego.usable, "the scene breaks no rule");
  auto kind = std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& one) {
    return road_difference2(one.road, known.ego) == 0.0;
  });
  if (kind == kinds_.end()) {
    kinds_.push_back({known.ego, std::vector<std::vector<Entry>>(cell_at(num_speeds, 0))});
    kind = kinds_.end() - 1;
  }
  const std::size_t cell = cell_of(known.ego);
  std::vector<Entry>& entries = kind->cells[cell];
  where_.push_back({static_cast<std::uint32_t>(kind - kinds_.begin()),
                    static_cast<std::uint32_t>(cell), static_cast<std::uint32_t>(entries.size())});
  entries.push_back({known.ego, static_cast<std::uint32_t>(ids_.size())});
  ids_.push_back(id);
  actors_.insert(actors_.end(), known.actors.begin(), known.actors.end());
  first_actor_.push_back(actors_.size());
}

std::size_t FeatureIndex::place_of(CaseId id) const {
  const auto found = std::lower_bound(ids_.begin(), ids_.end(), id);
  expects(found != ids_.end() && *found == id, "the id was added");
  return static_cast<std::size_t>(found - ids_.begin());
}

void FeatureIndex::pass_over(CaseId id) {
  const Where& where = where_[place_of(id)];
  kinds_[where.kind].cells[where.cell][where.entry].ego.usable = false;  // it is like no other
}

template <class Farthest, class Take>
void FeatureIndex::search(const Kind& kind, double apart2, const Features& wanted,
                          const Farthest& farthest, const Take& take) const noexcept {
  const std::span wanted_actors(wanted.actors.begin(), wanted.actors.size());
  const auto look = [&](const std::vector<Entry>& entries) {
    for (const Entry& entry : entries) {
      const std::span actors(actors_.data() + first_actor_[entry.place],
                             first_actor_[entry.place + 1] - first_actor_[entry.place]);
      // A little more than the farthest, so that who is as far is told exactly.
      const double limit = std::nextafter(farthest(), infinity);
      const double apart = difference(wanted.ego, wanted_actors, entry.ego, actors, limit);
      if (apart < limit) {
        take(Hit{ids_[entry.place], apart, entry.place});
      }
    }
  };
  // From the middle outwards, to either side in turn: gaps only grow on each side.
  const auto outwards = [](int middle, int count, const auto& goes_on) {
    bool up = goes_on(middle);
    bool down = up;
    for (int k = 1; up || down; ++k) {
      up = up && middle + k < count && goes_on(middle + k);
      down = down && middle - k >= 0 && goes_on(middle - k);
    }
  };
  const double speed = wanted.ego.v_L.x;
  const double grip = wanted.ego.log_grip;
  outwards(speeds.of(speed), num_speeds, [&](int i) {
    const double by_speed2 = apart2 + squared(speeds.gap(speed, i) / speed_scale);
    if (by_speed2 > squared(farthest())) {
      return false;
    }
    outwards(grips.of(grip), num_grips, [&](int j) {
      if (by_speed2 + squared(grips.gap(grip, j) / log_grip_scale) > squared(farthest())) {
        return false;
      }
      look(kind.cells[cell_at(i, j)]);
      return true;
    });
    return true;
  });
}

template <class Farthest, class Take>
void FeatureIndex::search(const Features& wanted, const Farthest& farthest,
                          const Take& take) const noexcept {
  for (const bool same : {true, false}) {  // its own kind of road first
    for (const Kind& kind : kinds_) {
      const double apart2 = road_difference2(kind.road, wanted.ego);
      if ((apart2 == 0.0) == same && apart2 <= squared(farthest())) {
        search(kind, apart2, wanted, farthest, take);
      }
    }
  }
}

std::optional<FeatureIndex::Hit> FeatureIndex::nearest(const Features& wanted) const noexcept {
  std::array<Hit, 1> room;
  return nearest(wanted, room) == 0 ? std::nullopt : std::optional(room.front());
}

std::size_t FeatureIndex::nearest(const Features& wanted, std::span<Hit> hits) const noexcept {
  if (hits.empty() || !wanted.ego.usable) {
    return 0;
  }
  std::size_t found = 0;  // a heap, the farthest first
  const auto end = [&] { return hits.begin() + static_cast<std::ptrdiff_t>(found); };
  double farthest = infinity;
  search(
      wanted, [&] { return farthest; },
      [&](const Hit& hit) {
        if (found < hits.size()) {
          hits[found++] = hit;
        } else if (nearer(hit, hits.front())) {
          std::pop_heap(hits.begin(), hits.end(), nearer);
          hits.back() = hit;
        } else {
          return;
        }
        std::push_heap(hits.begin(), end(), nearer);
        if (found == hits.size()) {
          farthest = hits.front().difference;
        }
      });
  std::sort_heap(hits.begin(), end(), nearer);
  return found;
}

}  // namespace saca::memory
