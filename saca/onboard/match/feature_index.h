#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "saca/onboard/match/case_id.h"
#include "saca/onboard/match/neighbour_graph.h"
#include "saca/onboard/match/similarity.h"

namespace saca::match {

/// The features of many scenes, packed to be searched.
///
/// Of few, scenes lie in cells of one kind of road and its markings, a step of the ego's speed and
/// one of the grip. A search goes from its own cell outwards and ends where no cell can hold
/// anything nearer than what was found: it is exact. Of many it goes from neighbour to neighbour
/// (NeighbourGraph), and now and then misses one (docs/decisions/0030-many-cases.md).
///
/// While nothing is added any number of threads may search; searching allocates nothing.
class FeatureIndex {
 public:
  struct Hit {
    CaseId id = 0;
    double difference = 0.0;
    std::size_t place = 0;  ///< how many were added before it
  };

  /// Up to this many are searched exactly.
  static constexpr std::size_t usually_exact = 20'000;
  explicit FeatureIndex(std::size_t most_exact = usually_exact) : most_exact_(most_exact) {}

  /// @param id     greater than all before
  /// @param scene  breaks no rule of `world::broken_rule`
  void add(CaseId id, const world::Scene& scene);

  /// From now on this one is not found.
  /// @param id  of one that was added
  void pass_over(CaseId id);

  /// How many were added before it.
  /// @param id  of one that was added
  [[nodiscard]] std::size_t place_of(CaseId id) const;

  /// As many of those that differ least as there is room for, the nearest first, the older of
  /// equals; of many at most NeighbourGraph::most_found.
  /// @return  how many were found
  [[nodiscard]] std::size_t nearest(const Features& wanted, std::span<Hit> hits) const noexcept;

  /// How far the nearest is of those that have another id; nullopt: there is none.
  [[nodiscard]] std::optional<double> nearest_other(const Features& wanted,
                                                    CaseId own) const noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return ids_.size(); }
  /// Memory that it takes [byte].
  [[nodiscard]] std::size_t bytes() const noexcept;
  /// 0 when there is none.
  [[nodiscard]] CaseId last_id() const noexcept { return ids_.empty() ? 0 : ids_.back(); }

 private:
  static constexpr int num_speeds = 96;  ///< steps of the ego's speed; the outer ones are open
  static constexpr int num_grips = 24;   ///< likewise of the logarithm of the grip

  struct Entry {
    ScaledEgo<float> ego;
    bool passed_over = false;
  };
  using Places = std::vector<std::uint32_t>;
  struct Kind {
    ScaledEgo<float> road;      ///< one of them
    std::vector<Places> cells;  ///< by speed, then by grip
  };
  struct Query {
    explicit Query(const Features& features) noexcept;
    ScaledEgo<float> ego;
    ScaledActors<float> actors;
  };

  [[nodiscard]] static std::size_t cell_at(int speed, int grip) noexcept;
  [[nodiscard]] static std::size_t cell_of(const ScaledEgo<float>& ego) noexcept;
  [[nodiscard]] std::span<const ScaledActor<float>> actors_of(std::uint32_t place) const noexcept {
    return {actors_.data() + first_actor_[place], first_actor_[place + 1] - first_actor_[place]};
  }
  /// Asks for what a place needs to be compared, without waiting for it.
  void prepare(std::uint32_t place) const noexcept;
  void add_to_cells(std::uint32_t place);
  void add_to_graph();
  /// Looks at all whose squared difference may be less than `farthest2()`, which may shrink
  /// meanwhile.
  template <class Farthest, class Take>
  void search(const Query& wanted, const Farthest& farthest2, const Take& take) const noexcept;
  template <class Farthest, class Take>
  void search(const Kind& kind, float apart2, const Query& wanted, const Farthest& farthest2,
              const Take& take) const noexcept;
  [[nodiscard]] std::size_t nearest_in_cells(const Query& wanted,
                                             std::span<Hit> hits) const noexcept;
  [[nodiscard]] std::size_t nearest_in_graph(const Query& wanted,
                                             std::span<Hit> hits) const noexcept;

  std::size_t most_exact_;
  std::vector<CaseId> ids_;
  std::vector<Entry> entries_;
  std::vector<ScaledActor<float>> actors_;     ///< scene after scene
  std::vector<std::uint32_t> first_actor_{0};  ///< of each scene, and behind the last
  std::size_t num_passed_over_ = 0;
  std::vector<Kind> kinds_;  ///< of few
  NeighbourGraph graph_;     ///< of many
};

}  // namespace saca::match
