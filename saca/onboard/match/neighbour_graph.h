#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace saca::match {

/// A graph of many things in which those that are like another are found by going from neighbour to
/// neighbour (hierarchical navigable small world: Y. A. Malkov, D. A. Yashunin, Efficient and
/// robust approximate nearest neighbor search using hierarchical navigable small world graphs,
/// IEEE TPAMI 42, 2020, algorithms 1 to 5).
///
/// It knows places 0, 1, ... only; the caller measures how far they are apart. The same places and
/// distances make the same graph. While nothing is added any number of threads may search;
/// searching allocates nothing and waits for nothing, and looks at a bounded number of places.
class NeighbourGraph {
 public:
  struct Neighbour {
    float distance = 0.0F;
    std::uint32_t place = 0;

    bool operator==(const Neighbour&) const = default;
    auto operator<=>(const Neighbour&) const = default;
  };

  static constexpr std::size_t most_found = 256;   ///< that a search keeps in view
  static constexpr std::size_t most_seen = 4'096;  ///< that a search looks at

  [[nodiscard]] std::size_t size() const noexcept { return level_of_.size(); }

  /// Adds the next place.
  /// @param apart  apart(place, place): float, >= 0, the same in both directions;
  ///               apart.prepare(place) as in `search`
  template <class Apart>
  void add(const Apart& apart);

  /// The nearest, with high probability, the nearest first, of equals the lower place.
  /// @param to  to(place, limit): float, >= 0; any number >= limit may come back instead of a
  ///            larger one. to.prepare(place): this place is looked at soon
  /// @return    how many were found: as many as there are places, or `found` has room for, or
  ///            most_found
  template <class To>
  [[nodiscard]] std::size_t search(const To& to, std::span<Neighbour> found) const noexcept;

  /// Memory of the graph alone [byte].
  [[nodiscard]] std::size_t bytes() const noexcept {
    return ground_.capacity() * sizeof(Links<2 * links>) +
           upper_.capacity() * sizeof(Links<links>) + level_of_.capacity() +
           first_upper_.capacity() * sizeof(std::uint32_t);
  }

 private:
  static constexpr std::size_t links = 16;        ///< of a place in each level; twice in the lowest
  static constexpr std::size_t in_view = 128;     ///< of a search
  static constexpr std::size_t when_added = 128;  ///< likewise while adding
  static constexpr int most_levels = 12;

  template <std::size_t N>
  struct Links {
    std::array<std::uint32_t, N> to;
    std::uint32_t count = 0;
  };

  /// Places that a search has seen: a table in which nobody is looked for twice.
  class VisitedSet {
   public:
    VisitedSet() { table_.fill(nobody); }
    /// @return  false: it was there, or the table is full
    bool add(std::uint32_t place) noexcept {
      if (count_ == most_seen) {
        return false;
      }
      std::size_t at = (place * std::size_t{0x9E3779B97F4A7C15U}) >> (64U - bits);
      for (; table_[at] != nobody; at = (at + 1) % table_.size()) {
        if (table_[at] == place) {
          return false;
        }
      }
      table_[at] = place;
      ++count_;
      return true;
    }

   private:
    static constexpr unsigned bits = 13;
    static_assert((std::size_t{1} << bits) == 2 * most_seen);
    static constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
    std::array<std::uint32_t, std::size_t{1} << bits> table_;
    std::size_t count_ = 0;
  };

  [[nodiscard]] std::span<const std::uint32_t> neighbours(std::uint32_t place, int level) const {
    if (level == 0) {
      return {ground_[place].to.data(), ground_[place].count};
    }
    const auto& of = upper_[first_upper_[place] + static_cast<std::uint32_t>(level) - 1];
    return {of.to.data(), of.count};
  }

  /// Of one level: goes on while anything comes nearer.
  template <class To>
  [[nodiscard]] Neighbour descend(const To& to, Neighbour from, int level) const noexcept {
    while (true) {
      Neighbour nearest = from;
      for (const std::uint32_t place : neighbours(from.place, level)) {
        nearest = std::min(nearest, {to(place, nearest.distance), place});
      }
      if (nearest == from) {
        return from;
      }
      from = nearest;
    }
  }

  /// Of one level: the nearest `room.size()`, in order.
  template <class To>
  [[nodiscard]] std::size_t look_around(const To& to, Neighbour from, int level,
                                        std::span<Neighbour> room) const noexcept;

  /// Of `all`, sorted, those that no one chosen before stands in front of.
  template <class Apart, std::size_t N>
  static void choose(const Apart& apart, std::span<const Neighbour> all, std::size_t most,
                     Links<N>& chosen) {
    chosen.count = 0;
    for (const Neighbour& one : all) {
      const bool hidden =
          std::any_of(chosen.to.begin(), chosen.to.begin() + chosen.count,
                      [&](std::uint32_t other) { return apart(other, one.place) < one.distance; });
      if (!hidden && chosen.count < most) {
        chosen.to[chosen.count++] = one.place;
      }
    }
  }

  template <class Apart, std::size_t N>
  static void link(const Apart& apart, Links<N>& of, std::uint32_t from, std::uint32_t to) {
    if (of.count < N) {
      of.to[of.count++] = to;
      return;
    }
    std::array<Neighbour, N + 1> all;
    for (std::size_t i = 0; i < N; ++i) {
      all[i] = {apart(from, of.to[i]), of.to[i]};
    }
    all[N] = {apart(from, to), to};
    std::sort(all.begin(), all.end());
    choose(apart, all, N, of);
  }

  /// Deterministic, and as rare as the method asks for: one place in `links` is a level up.
  static int level_of(std::uint32_t place) noexcept {
    std::uint64_t x = place + 0x9E3779B97F4A7C15U;  // splitmix64 (S. Vigna)
    x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
    x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
    constexpr int bits_of_links = std::countr_zero(links);
    return std::min(std::countr_zero((x ^ (x >> 31U)) | (std::uint64_t{1} << 60U)) / bits_of_links,
                    most_levels - 1);
  }

  std::vector<Links<2 * links>> ground_;    ///< by place
  std::vector<Links<links>> upper_;         ///< by place and level
  std::vector<std::uint32_t> first_upper_;  ///< by place
  std::vector<std::uint8_t> level_of_;      ///< by place
  std::uint32_t top_ = 0;                   ///< where searches begin
};

template <class Apart>
void NeighbourGraph::add(const Apart& apart) {
  const auto place = static_cast<std::uint32_t>(size());
  const int level = level_of(place);
  const int highest = place == 0 ? -1 : level_of_[top_];
  level_of_.push_back(static_cast<std::uint8_t>(level));
  first_upper_.push_back(static_cast<std::uint32_t>(upper_.size()));
  upper_.resize(upper_.size() + static_cast<std::size_t>(level));
  ground_.emplace_back();
  struct ToNew {
    const Apart& apart;
    std::uint32_t place;
    float operator()(std::uint32_t other, float /*limit*/) const { return apart(place, other); }
    void prepare(std::uint32_t other) const { apart.prepare(other); }
  };
  const ToNew to{apart, place};
  if (highest >= 0) {
    Neighbour from{to(top_, 0.0F), top_};
    for (int at = highest; at > level; --at) {
      from = descend(to, from, at);
    }
    for (int at = std::min(level, highest); at >= 0; --at) {
      std::array<Neighbour, when_added> room;
      const std::size_t count = look_around(to, from, at, room);
      const std::span<const Neighbour> around(room.data(), count);
      const auto join = [&](auto& all, auto index_of) {
        auto& own = all[index_of(place)];
        choose(apart, around, links, own);
        for (std::size_t i = 0; i < own.count; ++i) {
          link(apart, all[index_of(own.to[i])], own.to[i], place);
        }
      };
      if (at == 0) {
        join(ground_, [](std::uint32_t of) { return of; });
      } else {
        join(upper_, [&](std::uint32_t of) {
          return first_upper_[of] + static_cast<std::uint32_t>(at) - 1;
        });
      }
      from = around.front();
    }
  }
  if (level > highest) {
    top_ = place;
  }
}

template <class To>
std::size_t NeighbourGraph::look_around(const To& to, Neighbour from, int level,
                                        std::span<Neighbour> room) const noexcept {
  VisitedSet seen;
  seen.add(from.place);
  // Whose neighbours are still to be looked at: a heap, the nearest first.
  std::array<Neighbour, most_seen> waiting;
  waiting[0] = from;
  std::size_t num_waiting = 1;
  room[0] = from;  // a heap, the farthest first
  std::size_t count = 1;
  constexpr auto nearest_first = [](const Neighbour& a, const Neighbour& b) { return b < a; };
  const auto end_of = [](auto& all, std::size_t size) {
    return all.begin() + static_cast<std::ptrdiff_t>(size);
  };
  while (num_waiting > 0) {
    std::pop_heap(waiting.begin(), end_of(waiting, num_waiting), nearest_first);
    const Neighbour next = waiting[--num_waiting];
    if (count == room.size() && room.front() < next) {
      break;
    }
    // All are asked for before the first is looked at: most of a search is waiting for memory.
    std::array<std::uint32_t, 2 * links> unseen;
    std::size_t num_unseen = 0;
    for (const std::uint32_t place : neighbours(next.place, level)) {
      if (seen.add(place)) {
        unseen.at(num_unseen++) = place;
        to.prepare(place);
      }
    }
    for (const std::uint32_t place : std::span(unseen).first(num_unseen)) {
      const float limit =
          count == room.size() ? room.front().distance : std::numeric_limits<float>::infinity();
      const Neighbour one{to(place, limit), place};
      if (count == room.size()) {
        if (!(one < room.front())) {
          continue;
        }
        std::pop_heap(room.begin(), end_of(room, count));
        --count;
      }
      room[count++] = one;
      std::push_heap(room.begin(), end_of(room, count));
      waiting[num_waiting++] = one;
      std::push_heap(waiting.begin(), end_of(waiting, num_waiting), nearest_first);
    }
  }
  std::sort_heap(room.begin(), end_of(room, count));
  return count;
}

template <class To>
std::size_t NeighbourGraph::search(const To& to, std::span<Neighbour> found) const noexcept {
  if (size() == 0 || found.empty()) {
    return 0;
  }
  constexpr float no_limit = std::numeric_limits<float>::infinity();
  Neighbour from{to(top_, no_limit), top_};
  for (int level = level_of_[top_]; level > 0; --level) {
    from = descend(to, from, level);
  }
  std::array<Neighbour, most_found> room;
  const std::size_t kept = std::clamp(found.size(), in_view, most_found);
  const std::size_t count =
      std::min(look_around(to, from, 0, std::span(room).first(kept)), found.size());
  std::copy_n(room.begin(), count, found.begin());
  return count;
}

}  // namespace saca::match
