#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "saca/memory/case.h"
#include "saca/memory/similarity.h"

namespace saca::memory {

/// The features of many scenes, packed for one scan.
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
  /// As many of those that differ least as there is room for, the nearest first; who is like no
  /// other is left out.
  /// @return  how many were found
  [[nodiscard]] std::size_t nearest(const Features& wanted, std::span<Hit> hits) const noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return ids_.size(); }
  /// 0 when there is none.
  [[nodiscard]] CaseId last_id() const noexcept { return ids_.empty() ? 0 : ids_.back(); }

 private:
  /// Calls take(hit) with each that differs by less than `limit()`.
  template <class Limit, class Take>
  void scan(const Features& wanted, const Limit& limit, const Take& take) const noexcept;

  std::vector<CaseId> ids_;
  std::vector<EgoFeatures> egos_;
  std::vector<ActorFeatures> actors_;        ///< scene after scene
  std::vector<std::size_t> first_actor_{0};  ///< of each scene, and behind the last
};

}  // namespace saca::memory
