#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "saca/base/world/scene.h"
#include "saca/onboard/reflex/plan_cache.h"
#include "saca/onboard/reflex/reflex_plane.h"
#include "saca/onboard/reflex/verdict.h"
#include "saca/runtime/work_thread.h"
#include "saca/thinking/intent/observer.h"

namespace saca::runtime {

/// What is forgotten before a step.
enum class Reset : std::uint8_t {
  nothing,
  encounter,  ///< decision, plans and verdicts
  drive,      ///< also what was observed of the road users
};
[[nodiscard]] std::string_view name(Reset forgotten);

/// One instant of a drive: what went into the planes, and what came out.
struct TapeStep {
  std::uint64_t number = 0;                ///< of the scene, counted from the first of the drive on
  Reset forgotten = Reset::nothing;        ///< before this step
  world::Scene scene;                      ///< as it was perceived
  intent::Beliefs beliefs;                 ///< one per actor
  bool finished = false;                   ///< what was carried out had reached its safe end
  std::optional<reflex::PlanCache> plans;  ///< of the thinking plane, handed over in this step
  std::optional<NumberedVerdict> verdict;  ///< of the forecaster, likewise
  reflex::Reflex reflex;                   ///< what the reflex plane answered
  std::optional<reflex::Decision> decision;  ///< where it was triggered in this step
};

/// What a tape holds, unpacked.
struct TapeContent {
  reflex::PlanCache plans;                 ///< that the reflex plane had before the first step
  std::optional<reflex::Verdict> verdict;  ///< likewise
  std::uint64_t dropped = 0;               ///< older steps that gave way to newer ones
  std::uint64_t lost = 0;                  ///< newer steps for which there was no room
  std::vector<TapeStep> steps;             ///< by number; those that were lost are missing
};

/// Everything that the planes decided by, step by step, so that it can be worked out again bit by
/// bit (runtime/replay.h). It takes all its memory when it is made: adding a step allocates nothing
/// and writes no file.
///
/// When the memory is used up, the oldest steps give way: of a drive without danger one by one, of
/// an encounter in which something was decided all of them, because its rest could not be replayed.
/// The encounter under way keeps its begin; its later steps are then lost.
class Tape {
 public:
  /// The memory that one step needs at most [byte].
  /// @param num_actors  of its scene
  [[nodiscard]] static std::size_t step_size(std::size_t num_actors) noexcept;

  /// @param size  memory [byte]; 0: nothing is recorded
  explicit Tape(std::size_t size);

  [[nodiscard]] bool records() const noexcept { return !ring_.empty(); }

  /// Numbers rise from step to step.
  void add(const TapeStep& step) noexcept;

  /// All steps; allocates. On the thread that adds.
  [[nodiscard]] TapeContent content() const;

 private:
  using Size = std::uint32_t;

  [[nodiscard]] Size size_at(std::size_t at) const noexcept;
  void put(std::size_t at, const void* from, std::size_t size) noexcept;
  void get(std::size_t at, void* to, std::size_t size) const noexcept;
  void unpack_at(std::size_t at, TapeStep& step) const;
  [[nodiscard]] bool make_room(std::size_t size) noexcept;
  void drop_oldest() noexcept;

  std::vector<std::byte> ring_;
  std::size_t first_ = 0;  ///< of the oldest step in the ring
  std::size_t used_ = 0;
  std::vector<std::byte> packed_;              ///< one step
  std::unique_ptr<TapeStep> oldest_;           ///< unpacked
  TapeContent before_;                         ///< all but its steps
  std::optional<std::uint64_t> newest_begin_;  ///< the newest step before which all was forgotten
  bool stopped_ = false;                       ///< until something is forgotten
};

}  // namespace saca::runtime
