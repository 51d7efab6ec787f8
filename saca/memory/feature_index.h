#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "saca/memory/case.h"
#include "saca/memory/similarity.h"

namespace saca::memory {

/// The features of many scenes, packed to be searched.
///
/// Scenes lie in cells of one kind of road and its markings, a step of the ego's speed and one of
/// the grip. A search goes from its own cell outwards and ends where no cell can hold anything
/// nearer than what was found: exact, and it looks at few. Searching allocates nothing.
class FeatureIndex {
 public:
  struct Hit {
    CaseId id = 0;
    double difference = 0.0;
    std::size_t place = 0;  ///< how many were added before it
  };

  /// @param id     greater than all before
  /// @param scene  breaks no rule of `world::broken_rule`
  void add(CaseId id, const world::Scene& scene);

  /// From now on this one is not found.
  /// @param id  of one that was added
  void pass_over(CaseId id);

  /// How many were added before it.
  /// @param id  of one that was added
  [[nodiscard]] std::size_t place_of(CaseId id) const;

  /// The scene that differs least, the oldest of equals; nullopt when there is none.
  [[nodiscard]] std::optional<Hit> nearest(const Features& wanted) const noexcept;
  /// As many of those that differ least as there is room for, the nearest first, the older of
  /// equals; who is like no other is left out.
  /// @return  how many were found
  [[nodiscard]] std::size_t nearest(const Features& wanted, std::span<Hit> hits) const noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return ids_.size(); }
  /// 0 when there is none.
  [[nodiscard]] CaseId last_id() const noexcept { return ids_.empty() ? 0 : ids_.back(); }

 private:
  static constexpr int num_speeds = 96;  ///< steps of the ego's speed; the outer ones are open
  static constexpr int num_grips = 24;   ///< likewise of the logarithm of the grip

  struct Entry {
    EgoFeatures ego;
    std::uint32_t place = 0;
  };
  /// Scenes of one kind of road with the same markings.
  struct Kind {
    EgoFeatures road;                       ///< one of them
    std::vector<std::vector<Entry>> cells;  ///< by speed, then by grip
  };
  /// Where a case lies.
  struct Where {
    std::uint32_t kind = 0;
    std::uint32_t cell = 0;
    std::uint32_t entry = 0;
  };

  [[nodiscard]] static std::size_t cell_at(int speed, int grip) noexcept;
  [[nodiscard]] static std::size_t cell_of(const EgoFeatures& ego) noexcept;
  /// Looks at all that may differ by less than `farthest()`, which may shrink meanwhile.
  template <class Farthest, class Take>
  void search(const Features& wanted, const Farthest& farthest, const Take& take) const noexcept;
  template <class Farthest, class Take>
  void search(const Kind& kind, double apart2, const Features& wanted, const Farthest& farthest,
              const Take& take) const noexcept;

  std::vector<CaseId> ids_;
  std::vector<Where> where_;
  std::vector<Kind> kinds_;
  std::vector<ActorFeatures> actors_;        ///< scene after scene
  std::vector<std::size_t> first_actor_{0};  ///< of each scene, and behind the last
};

}  // namespace saca::memory
