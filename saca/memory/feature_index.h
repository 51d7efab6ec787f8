#pragma once

#include <cstddef>
#include <optional>
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
  };

  /// @param id     greater than all before
  /// @param scene  breaks no rule of `world::broken_rule`
  void add(CaseId id, const world::Scene& scene);

  /// From now on this one is not found.
  /// @param id  of one that was added
  void pass_over(CaseId id);

  /// The scene that differs least, the oldest of equals; nullopt when there is none.
  [[nodiscard]] std::optional<Hit> nearest(const Features& wanted) const noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return ids_.size(); }
  /// 0 when there is none.
  [[nodiscard]] CaseId last_id() const noexcept { return ids_.empty() ? 0 : ids_.back(); }

 private:
  std::vector<CaseId> ids_;
  std::vector<EgoFeatures> egos_;
  std::vector<ActorFeatures> actors_;        ///< scene after scene
  std::vector<std::size_t> first_actor_{0};  ///< of each scene, and behind the last
};

}  // namespace saca::memory
