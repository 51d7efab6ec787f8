#include "saca/lab/recordings/series.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "saca/base/core/contract.h"

namespace saca::recordings {
namespace {

/// Rows within `half` steps of `i`, as [first, last].
std::pair<std::size_t, std::size_t> around(std::size_t i, std::size_t half, std::size_t size) {
  return {i > half ? i - half : 0, std::min(i + half, size - 1)};
}

}  // namespace

FilledSeries filled(const std::vector<double>& series) {
  const auto seen = [](double value) { return !std::isnan(value); };
  expects(std::any_of(series.begin(), series.end(), seen), "not all values are missing");
  FilledSeries result{series, 0};
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < series.size(); ++i) {
    if (!seen(series[i])) {
      ++result.num_filled;
      if (last) {
        result.values[i] = series[*last];
      }
      continue;
    }
    const double from = last ? series[*last] : series[i];
    const std::size_t begin = last ? *last + 1 : 0;
    const double span = static_cast<double>(i) - static_cast<double>(begin) + 1.0;
    for (std::size_t k = begin; k < i; ++k) {
      const double share = static_cast<double>(k - begin + 1) / span;
      result.values[k] = from + share * (series[i] - from);
    }
    last = i;
  }
  return result;
}

std::size_t remove_outliers(std::vector<double>& series, const std::vector<double>& slopes,
                            double step, std::size_t half, double bound) {
  expects(slopes.size() == series.size(), "as many slopes as values");
  expects(step > 0.0, "step > 0");
  const std::vector<double> before = series;
  std::vector<double> predicted;
  std::size_t removed = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (std::isnan(before[i])) {
      continue;
    }
    const auto [first, last] = around(i, half, before.size());
    predicted.clear();
    for (std::size_t k = first; k <= last; ++k) {
      if (!std::isnan(before[k])) {
        const double ahead = step * (static_cast<double>(i) - static_cast<double>(k));
        predicted.push_back(before[k] + slopes[k] * ahead);
      }
    }
    const auto middle = predicted.begin() + static_cast<std::ptrdiff_t>(predicted.size() / 2);
    std::nth_element(predicted.begin(), middle, predicted.end());
    if (std::abs(before[i] - *middle) > bound) {
      series[i] = missing;
      ++removed;
    }
  }
  return removed;
}

std::vector<double> without_holds(const std::vector<double>& series, std::size_t longest_hold) {
  std::vector<double> kept(series.size(), missing);
  for (std::size_t i = 0; i < series.size();) {
    std::size_t end = i + 1;
    while (end < series.size() && series[end] == series[i]) {
      ++end;
    }
    kept[i] = series[i];
    if (end - i > longest_hold) {
      // The sensor's next value was due `longest_hold` after the last one that it really sent.
      for (std::size_t k = i; k + longest_hold < end; ++k) {
        kept[k] = series[i];
      }
    }
    i = end;
  }
  if (!series.empty()) {
    kept.back() = series.back();
  }
  return kept;
}

Fit line_fit(const std::vector<double>& values, double step, std::size_t half) {
  expects(step > 0.0, "step > 0");
  Fit fit;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto [first, last] = around(i, half, values.size());
    double n = 0.0;
    double t1 = 0.0;
    double t2 = 0.0;
    double y0 = 0.0;
    double y1 = 0.0;
    for (std::size_t k = first; k <= last; ++k) {
      const double t = step * (static_cast<double>(k) - static_cast<double>(i));
      n += 1.0;
      t1 += t;
      t2 += t * t;
      y0 += values[k];
      y1 += t * values[k];
    }
    const double spread = n * t2 - t1 * t1;
    const double slope = spread > 0.0 ? (n * y1 - t1 * y0) / spread : 0.0;
    fit.slopes.push_back(slope);
    fit.values.push_back((y0 - slope * t1) / n);
  }
  return fit;
}

Fit parabola_fit(const std::vector<double>& values, const std::vector<double>& slopes, double step,
                 std::size_t half, double slope_weight) {
  expects(step > 0.0, "step > 0");
  expects(slope_weight > 0.0, "slope_weight > 0");
  expects(values.size() == slopes.size(), "as many slopes as values");
  Fit fit;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto [first, last] = around(i, half, values.size());
    Normal3 normal;
    for (std::size_t k = first; k <= last; ++k) {
      const double t = step * (static_cast<double>(k) - static_cast<double>(i));
      normal.add({1.0, t, 0.5 * t * t}, values[k], 1.0);
      normal.add({0.0, 1.0, t}, slopes[k], slope_weight);
    }
    const std::array<double, 3> p = normal.solution();
    fit.values.push_back(p[0]);
    fit.slopes.push_back(p[1]);
  }
  return fit;
}

std::vector<double> never_falling(const std::vector<double>& series) {
  struct Block {
    double sum;
    std::size_t size;
  };
  const auto mean = [](const Block& block) { return block.sum / static_cast<double>(block.size); };
  std::vector<Block> blocks;
  for (const double value : series) {
    blocks.push_back({value, 1});
    while (blocks.size() > 1 && mean(blocks[blocks.size() - 2]) > mean(blocks.back())) {
      const Block last = blocks.back();
      blocks.pop_back();
      blocks.back().sum += last.sum;
      blocks.back().size += last.size;
    }
  }
  std::vector<double> result;
  for (const Block& block : blocks) {
    result.insert(result.end(), block.size, mean(block));
  }
  return result;
}

std::vector<double> integral(const std::vector<double>& rates, double step) {
  std::vector<double> sums(rates.size(), 0.0);
  for (std::size_t i = 1; i < rates.size(); ++i) {
    sums[i] = sums[i - 1] + 0.5 * step * (rates[i - 1] + rates[i]);
  }
  return sums;
}

template <std::size_t num_unknowns>
void NormalEquations<num_unknowns>::add(const std::array<double, num_unknowns>& row, double value,
                                        double weight) {
  for (std::size_t r = 0; r < num_unknowns; ++r) {
    for (std::size_t c = 0; c < num_unknowns; ++c) {
      matrix_[r][c] += weight * row[r] * row[c];
    }
    right_[r] += weight * row[r] * value;
  }
}

template <std::size_t num_unknowns>
std::array<double, num_unknowns> NormalEquations<num_unknowns>::solution() const {
  auto a = matrix_;
  auto b = right_;
  std::array<bool, num_unknowns> used{};
  // Gauss on a positive semi-definite matrix: no pivoting is needed, and a row that vanishes is a
  // parameter that the data do not determine.
  for (std::size_t p = 0; p < num_unknowns; ++p) {
    used[p] = a[p][p] > 1e-9 * matrix_[p][p];
    if (!used[p]) {
      continue;
    }
    for (std::size_t r = 0; r < num_unknowns; ++r) {
      if (r == p) {
        continue;
      }
      const double factor = a[r][p] / a[p][p];
      for (std::size_t c = 0; c < num_unknowns; ++c) {
        a[r][c] -= factor * a[p][c];
      }
      b[r] -= factor * b[p];
    }
  }
  std::array<double, num_unknowns> x{};
  for (std::size_t p = 0; p < num_unknowns; ++p) {
    x[p] = used[p] ? b[p] / a[p][p] : 0.0;
  }
  return x;
}

template class NormalEquations<3>;
template class NormalEquations<4>;

}  // namespace saca::recordings
