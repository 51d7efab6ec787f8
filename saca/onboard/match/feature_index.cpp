#include "saca/onboard/match/feature_index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "saca/base/core/contract.h"

namespace saca::match {
namespace {

constexpr auto infinity = std::numeric_limits<float>::infinity();

/// Equal steps of a quantity, each as wide as a difference of 1; the first begins and the last ends
/// at infinity.
struct Steps {
  float low = 0.0F;  ///< where the second begins
  int count = 1;

  [[nodiscard]] int of(float value) const {
    const float step = std::floor(value - low) + 1.0F;
    return static_cast<int>(std::clamp(step, 0.0F, static_cast<float>(count - 1)));
  }
  /// Least distance from a value to what lies in a step.
  [[nodiscard]] float gap(float value, int step) const {
    const float from = step == 0 ? -infinity : low + static_cast<float>(step - 1);
    const float to = step == count - 1 ? infinity : low + static_cast<float>(step);
    return std::max({from - value, value - to, 0.0F});
  }
};

constexpr float squared(float x) {
  return x * x;
}

/// Smaller differences first, of equals the older.
bool nearer(const FeatureIndex::Hit& a, const FeatureIndex::Hit& b) {
  return a.difference != b.difference ? a.difference < b.difference : a.id < b.id;
}

constexpr Steps speeds{-7.0F, 96};
constexpr Steps grips{-21.0F, 24};

}  // namespace

FeatureIndex::Query::Query(const Features& features) noexcept
    : ego(scaled<float>(features.ego)),
      actors(scaled<float>(std::span(features.actors.begin(), features.actors.size()))) {}

std::size_t FeatureIndex::cell_at(int speed, int grip) noexcept {
  return static_cast<std::size_t>(speed) * num_grips + static_cast<std::size_t>(grip);
}

std::size_t FeatureIndex::cell_of(const ScaledEgo<float>& ego) noexcept {
  static_assert(speeds.count == num_speeds && grips.count == num_grips);
  return cell_at(speeds.of(ego.parts[ego_speed]), grips.of(ego.parts[ego_grip]));
}

void FeatureIndex::add(CaseId id, const world::Scene& scene) {
  expects(id > last_id(), "id > last_id()");
  const Features known = features(scene);
  expects(known.ego.usable, "the scene breaks no rule");
  const Query packed(known);
  const auto place = static_cast<std::uint32_t>(ids_.size());
  ids_.push_back(id);
  entries_.push_back({.ego = packed.ego});
  actors_.insert(actors_.end(), packed.actors.begin(), packed.actors.end());
  first_actor_.push_back(static_cast<std::uint32_t>(actors_.size()));
  if (ids_.size() <= most_exact_) {
    add_to_cells(place);
    return;
  }
  kinds_.clear();
  while (graph_.size() < ids_.size()) {
    add_to_graph();
  }
}

void FeatureIndex::add_to_cells(std::uint32_t place) {
  const ScaledEgo<float>& ego = entries_[place].ego;
  auto kind = std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& one) {
    return road_difference2(one.road, ego) == 0.0F;
  });
  if (kind == kinds_.end()) {
    kinds_.push_back({ego, std::vector<Places>(cell_at(num_speeds, 0))});
    kind = kinds_.end() - 1;
  }
  kind->cells[cell_of(ego)].push_back(place);
}

void FeatureIndex::add_to_graph() {
  struct Apart {
    const FeatureIndex& of;
    float operator()(std::uint32_t a, std::uint32_t b) const {
      return difference2(of.entries_[a].ego, of.actors_of(a), of.entries_[b].ego, of.actors_of(b),
                         infinity);
    }
    void prepare(std::uint32_t place) const { of.prepare(place); }
  };
  graph_.add(Apart{*this});
}

void FeatureIndex::prepare(std::uint32_t place) const noexcept {
  __builtin_prefetch(&entries_[place]);
  const auto* const actors = actors_.data() + first_actor_[place];
  __builtin_prefetch(actors);
  __builtin_prefetch(actors + 1);
}

std::size_t FeatureIndex::place_of(CaseId id) const {
  const auto found = std::lower_bound(ids_.begin(), ids_.end(), id);
  expects(found != ids_.end() && *found == id, "the id was added");
  return static_cast<std::size_t>(found - ids_.begin());
}

void FeatureIndex::pass_over(CaseId id) {
  Entry& entry = entries_[place_of(id)];
  num_passed_over_ += entry.passed_over ? 0U : 1U;
  entry.passed_over = true;
}

std::size_t FeatureIndex::bytes() const noexcept {
  std::size_t cells = 0;
  for (const Kind& kind : kinds_) {
    cells += kind.cells.capacity() * sizeof(Places);
    for (const Places& places : kind.cells) {
      cells += places.capacity() * sizeof(std::uint32_t);
    }
  }
  return ids_.capacity() * sizeof(CaseId) + entries_.capacity() * sizeof(Entry) +
         actors_.capacity() * sizeof(ScaledActor<float>) +
         first_actor_.capacity() * sizeof(std::uint32_t) + cells + graph_.bytes();
}

template <class Farthest, class Take>
void FeatureIndex::search(const Kind& kind, float apart2, const Query& wanted,
                          const Farthest& farthest2, const Take& take) const noexcept {
  const std::span<const ScaledActor<float>> actors(wanted.actors.begin(), wanted.actors.size());
  const auto look = [&](const Places& places) {
    for (const std::uint32_t place : places) {
      const Entry& entry = entries_[place];
      if (entry.passed_over) {
        continue;
      }
      // A little more than the farthest, so that who is as far is told exactly.
      const float limit2 = std::nextafter(farthest2(), infinity);
      const float between2 = difference2(wanted.ego, actors, entry.ego, actors_of(place), limit2);
      if (between2 < limit2) {
        take(between2, place);
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
  const float speed = wanted.ego.parts[ego_speed];
  const float grip = wanted.ego.parts[ego_grip];
  outwards(speeds.of(speed), num_speeds, [&](int i) {
    const float by_speed2 = apart2 + squared(speeds.gap(speed, i));
    if (by_speed2 > farthest2()) {
      return false;
    }
    outwards(grips.of(grip), num_grips, [&](int j) {
      if (by_speed2 + squared(grips.gap(grip, j)) > farthest2()) {
        return false;
      }
      look(kind.cells[cell_at(i, j)]);
      return true;
    });
    return true;
  });
}

template <class Farthest, class Take>
void FeatureIndex::search(const Query& wanted, const Farthest& farthest2,
                          const Take& take) const noexcept {
  for (const bool same : {true, false}) {  // its own kind of road first
    for (const Kind& kind : kinds_) {
      const float apart2 = road_difference2(kind.road, wanted.ego);
      if ((apart2 == 0.0F) == same && apart2 <= farthest2()) {
        search(kind, apart2, wanted, farthest2, take);
      }
    }
  }
}

std::optional<double> FeatureIndex::nearest_other(const Features& wanted,
                                                  CaseId own) const noexcept {
  std::array<Hit, 2> room;
  const std::size_t found = nearest(wanted, room);
  for (const Hit& hit : std::span(room).first(found)) {
    if (hit.id != own) {
      return hit.difference;
    }
  }
  return std::nullopt;
}

std::size_t FeatureIndex::nearest(const Features& wanted, std::span<Hit> hits) const noexcept {
  if (hits.empty() || !wanted.ego.usable) {
    return 0;
  }
  const Query packed(wanted);
  return graph_.size() == 0 ? nearest_in_cells(packed, hits) : nearest_in_graph(packed, hits);
}

std::size_t FeatureIndex::nearest_in_cells(const Query& wanted,
                                           std::span<Hit> hits) const noexcept {
  std::size_t found = 0;  // a heap, the farthest first; differences are squares
  const auto end = [&] { return hits.begin() + static_cast<std::ptrdiff_t>(found); };
  float farthest2 = infinity;
  search(
      wanted, [&] { return farthest2; },
      [&](float between2, std::uint32_t place) {
        const Hit hit{ids_[place], between2, place};
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
          farthest2 = static_cast<float>(hits.front().difference);
        }
      });
  std::sort_heap(hits.begin(), end(), nearer);
  for (Hit& hit : hits.first(found)) {
    hit.difference = std::sqrt(hit.difference);
  }
  return found;
}

std::size_t FeatureIndex::nearest_in_graph(const Query& wanted,
                                           std::span<Hit> hits) const noexcept {
  std::array<NeighbourGraph::Neighbour, NeighbourGraph::most_found> room;
  const std::size_t wanted_size =
      std::min(room.size(), hits.size() + std::min(num_passed_over_, room.size()));
  const std::span<const ScaledActor<float>> actors(wanted.actors.begin(), wanted.actors.size());
  struct To {
    const FeatureIndex& of;
    const ScaledEgo<float>& ego;
    std::span<const ScaledActor<float>> actors;
    float operator()(std::uint32_t place, float limit2) const {
      return difference2(ego, actors, of.entries_[place].ego, of.actors_of(place), limit2);
    }
    void prepare(std::uint32_t place) const { of.prepare(place); }
  };
  const std::size_t count =
      graph_.search(To{*this, wanted.ego, actors}, std::span(room).first(wanted_size));
  std::size_t found = 0;
  for (std::size_t i = 0; i < count && found < hits.size(); ++i) {
    const std::uint32_t place = room.at(i).place;
    if (!entries_[place].passed_over) {
      hits[found++] = {ids_[place], std::sqrt(static_cast<double>(room.at(i).distance)), place};
    }
  }
  return found;
}

}  // namespace saca::match
