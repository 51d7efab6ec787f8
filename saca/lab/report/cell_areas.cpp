#include "saca/lab/report/cell_areas.h"

#include <algorithm>

#include "saca/base/core/contract.h"
#include "saca/base/core/vec2.h"

namespace saca::report {
namespace {

class CellAreas {
 public:
  CellAreas(std::span<const int> keys, std::size_t columns)
      : keys_(keys), columns_(columns), area_(keys.size(), none), depth_(keys.size(), 1) {
    for (std::size_t first = 0; first < keys.size(); ++first) {
      if (area_[first] == none) {
        fill_from(first);
      }
    }
    measure_depths();
  }

  [[nodiscard]] std::vector<std::size_t> centres() const {
    const std::vector<Vec2> middle = middles();
    std::vector<std::size_t> best(count_, none);
    for (std::size_t i = 0; i < area_.size(); ++i) {
      std::size_t& old = best[area_[i]];
      const auto away = [&](std::size_t cell) { return norm(place(cell) - middle[area_[i]]); };
      constexpr double rounding = 1e-9;
      if (old == none || depth_[i] > depth_[old] ||
          (depth_[i] == depth_[old] && away(i) < away(old) - rounding)) {
        old = i;
      }
    }
    return best;
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  [[nodiscard]] bool has_left(std::size_t i) const { return i % columns_ > 0; }
  [[nodiscard]] bool has_right(std::size_t i) const { return (i + 1) % columns_ > 0; }
  [[nodiscard]] bool has_before(std::size_t i) const { return i >= columns_; }
  [[nodiscard]] bool has_after(std::size_t i) const { return i + columns_ < keys_.size(); }

  /// Of a cell, counted in cells.
  [[nodiscard]] Vec2 place(std::size_t i) const {
    const std::size_t row = i / columns_;
    return {static_cast<double>(i % columns_), static_cast<double>(row)};
  }

  void fill_from(std::size_t first) {
    std::vector<std::size_t> open{first};
    area_[first] = count_;
    const auto visit = [&](bool exists, std::size_t i) {
      if (exists && area_[i] == none && keys_[i] == keys_[first]) {
        area_[i] = count_;
        open.push_back(i);
      }
    };
    while (!open.empty()) {
      const std::size_t i = open.back();
      open.pop_back();
      visit(has_left(i), i - 1);
      visit(has_right(i), i + 1);
      visit(has_before(i), i - columns_);
      visit(has_after(i), i + columns_);
    }
    ++count_;
  }

  /// Steps from each cell out of its area: two sweeps.
  void measure_depths() {
    const auto beyond = [&](std::size_t i, bool exists, std::size_t j) {
      return exists && area_[j] == area_[i] ? depth_[j] + 1 : 1;
    };
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      depth_[i] = std::min(beyond(i, has_left(i), i - 1), beyond(i, has_before(i), i - columns_));
    }
    for (std::size_t i = keys_.size(); i-- > 0;) {
      depth_[i] = std::min(
          {depth_[i], beyond(i, has_right(i), i + 1), beyond(i, has_after(i), i + columns_)});
    }
  }

  [[nodiscard]] std::vector<Vec2> middles() const {
    std::vector<Vec2> middle(count_);
    std::vector<double> cells(count_);
    for (std::size_t i = 0; i < area_.size(); ++i) {
      middle[area_[i]] = middle[area_[i]] + place(i);
      cells[area_[i]] += 1.0;
    }
    for (std::size_t k = 0; k < count_; ++k) {
      middle[k] = (1.0 / cells[k]) * middle[k];
    }
    return middle;
  }

  std::span<const int> keys_;
  std::size_t columns_;
  std::vector<std::size_t> area_;  ///< of each cell
  std::vector<int> depth_;         ///< of each cell
  std::size_t count_ = 0;          ///< of areas
};

}  // namespace

std::vector<std::size_t> area_centres(std::span<const int> keys, std::size_t columns) {
  expects(columns > 0 && keys.size() % columns == 0, "columns > 0, rows are full");
  return CellAreas(keys, columns).centres();
}

}  // namespace saca::report
