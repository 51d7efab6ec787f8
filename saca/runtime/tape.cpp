#include "saca/runtime/tape.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>

#include "saca/base/core/names.h"

namespace saca::runtime {
namespace {

constexpr std::array<std::string_view, 3> forgotten_names{"nothing", "encounter", "drive"};

/// Writes values one behind the other, of lists only what they hold.
class Packer {
 public:
  explicit Packer(std::byte* to) : to_(to) {}

  template <class T>
  void value(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(to_ + size_, &value, sizeof value);
    size_ += sizeof value;
  }
  template <class T, std::size_t capacity, class Each>
  void list(const StaticVector<T, capacity>& list, Each&& each) {
    value(list.size());
    for (const T& item : list) {
      each(item);
    }
  }
  template <class T, class Each>
  void optional(const std::optional<T>& optional, Each&& each) {
    value(optional.has_value());
    if (optional) {
      each(*optional);
    }
  }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  std::byte* to_;
  std::size_t size_ = 0;
};

/// Reads what a Packer wrote.
class Unpacker {
 public:
  explicit Unpacker(const std::byte* from) : from_(from) {}

  template <class T>
  void value(T& value) {
    std::memcpy(&value, from_, sizeof value);
    from_ += sizeof value;
  }
  template <class T, std::size_t capacity, class Each>
  void list(StaticVector<T, capacity>& list, Each&& each) {
    std::size_t size = 0;
    value(size);
    list.clear();
    for (std::size_t i = 0; i < size; ++i) {
      T item{};
      each(item);
      list.push_back(item);
    }
  }
  template <class T, class Each>
  void optional(std::optional<T>& optional, Each&& each) {
    bool has_value = false;
    value(has_value);
    optional.reset();
    if (has_value) {
      each(optional.emplace());
    }
  }

 private:
  const std::byte* from_;
};

/// The one order in which a step is packed and unpacked.
template <class Packing, class Step>
void pass(Packing& packing, Step& step) {
  const auto whole = [&](auto& value) { packing.value(value); };
  packing.value(step.number);
  packing.value(step.forgotten);
  packing.value(step.scene.time);
  packing.value(step.scene.ego);
  packing.value(step.scene.ego_footprint);
  packing.value(step.scene.ego_mass);
  packing.list(step.scene.actors, whole);
  packing.value(step.scene.road);
  packing.value(step.scene.grip);
  packing.value(step.scene.grip_sd);
  packing.list(step.scene.cues, whole);
  packing.list(step.beliefs, whole);
  packing.value(step.finished);
  packing.optional(step.plans, [&](auto& plans) {
    packing.list(plans, [&](auto& cached) {
      packing.value(cached.at_trigger.ego);
      packing.list(cached.at_trigger.actors, whole);
      packing.value(cached.trigger);
      packing.value(cached.plan);
      packing.value(cached.source);
      packing.value(cached.worse_than_aeb);
      packing.value(cached.preview);
    });
  });
  packing.optional(step.verdict, whole);
  packing.value(step.reflex);
  packing.optional(step.decision, whole);
}

}  // namespace

std::string_view name(Reset forgotten) {
  return name_of(forgotten, forgotten_names);
}

std::size_t Tape::step_size(std::size_t num_actors) noexcept {
  const std::size_t missing = world::max_actors - std::min(num_actors, world::max_actors);
  const std::size_t less = missing * (sizeof(world::Actor) + sizeof(intent::Belief) +
                                      reflex::PlanCache::capacity() * sizeof(match::ActorFeatures));
  return sizeof(Size) + sizeof(TapeStep) - less;
}

Tape::Tape(std::size_t size)
    : ring_(size),
      packed_(size == 0 ? 0 : sizeof(TapeStep)),
      oldest_(size == 0 ? nullptr : std::make_unique<TapeStep>()) {}

void Tape::add(const TapeStep& step) noexcept {
  if (!records()) {
    return;
  }
  if (step.forgotten != Reset::nothing) {
    newest_begin_ = step.number;
    stopped_ = false;
  }
  Packer packer(packed_.data());
  pass(packer, step);
  const auto size = static_cast<Size>(packer.size());
  if (stopped_ || !make_room(sizeof(Size) + size)) {
    stopped_ = true;
    ++before_.lost;
    return;
  }
  const std::size_t end = first_ + used_;
  put(end, &size, sizeof size);
  put(end + sizeof size, packed_.data(), size);
  used_ += sizeof size + size;
}

TapeContent Tape::content() const {
  TapeContent content = before_;
  for (std::size_t at = 0; at < used_; at += sizeof(Size) + size_at(first_ + at)) {
    unpack_at(first_ + at, content.steps.emplace_back());
  }
  return content;
}

Tape::Size Tape::size_at(std::size_t at) const noexcept {
  Size size = 0;
  get(at, &size, sizeof size);
  return size;
}

void Tape::put(std::size_t at, const void* from, std::size_t size) noexcept {
  const std::size_t begin = at % ring_.size();
  const std::size_t first = std::min(size, ring_.size() - begin);
  std::memcpy(&ring_[begin], from, first);
  std::memcpy(ring_.data(), static_cast<const std::byte*>(from) + first, size - first);
}

void Tape::get(std::size_t at, void* to, std::size_t size) const noexcept {
  const std::size_t begin = at % ring_.size();
  const std::size_t first = std::min(size, ring_.size() - begin);
  std::memcpy(to, &ring_[begin], first);
  std::memcpy(static_cast<std::byte*>(to) + first, ring_.data(), size - first);
}

void Tape::unpack_at(std::size_t at, TapeStep& step) const {
  std::array<std::byte, sizeof(TapeStep)> bytes;
  get(at + sizeof(Size), bytes.data(), size_at(at));
  Unpacker unpacker(bytes.data());
  pass(unpacker, step);
}

bool Tape::make_room(std::size_t size) noexcept {
  while (ring_.size() - used_ < size) {
    if (used_ == 0) {
      return false;
    }
    unpack_at(first_, *oldest_);
    const bool decides = oldest_->reflex.triggered;
    if (decides && (!newest_begin_ || *newest_begin_ <= oldest_->number)) {
      return false;
    }
    drop_oldest();
    while (decides && used_ > 0) {
      unpack_at(first_, *oldest_);
      if (oldest_->forgotten != Reset::nothing) {
        break;
      }
      drop_oldest();
    }
  }
  return true;
}

void Tape::drop_oldest() noexcept {
  if (oldest_->forgotten != Reset::nothing) {
    before_.plans.clear();
    before_.verdict.reset();
  }
  if (oldest_->plans) {
    before_.plans = *oldest_->plans;
  }
  if (oldest_->verdict) {
    before_.verdict = oldest_->verdict->verdict;
  }
  ++before_.dropped;
  const std::size_t size = sizeof(Size) + size_at(first_);
  first_ = (first_ + size) % ring_.size();
  used_ -= size;
}

}  // namespace saca::runtime
