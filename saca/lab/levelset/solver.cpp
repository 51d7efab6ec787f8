#include "saca/lab/levelset/solver.h"

#include <fmt/core.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <utility>

#include "saca/base/core/contract.h"

namespace saca::levelset {
namespace {

std::size_t num_stages(Steps steps) {
  return steps == Steps::euler ? 1 : steps == Steps::tvd_rk2 ? 2 : 3;
}

/// Arrays of values beside h: the present ones and those of one or two stages.
std::size_t num_arrays(Steps steps) {
  return steps == Steps::euler ? 2 : 3;
}

template <class Real>
std::vector<Real> readable(std::size_t cells) {
  return std::vector<Real>(cells + readable_beyond, Real(0));
}

/// Greatest difference between neighbours along an axis, but a thousandth of h's range at least:
/// where h does not depend on the axis, its rounding is no measure of what the value will do.
template <class Real>
double steepness(const danger::Grid& grid, std::span<const Real> h, std::size_t axis) {
  const std::size_t stride = danger::strides(grid)[axis];
  const auto points = static_cast<std::size_t>(grid.axes[axis].points);
  double greatest = 0.0;
  for (std::size_t i = 0; i < h.size(); ++i) {
    if (i / stride % points + 1 < points) {
      greatest = std::max(greatest, std::abs(static_cast<double>(h[i + stride] - h[i])));
    }
  }
  const auto [low, high] = std::minmax_element(h.begin(), h.end());
  greatest = std::max(greatest, 1e-3 * (static_cast<double>(*high) - static_cast<double>(*low)));
  return greatest > 0.0 ? greatest : 1.0;
}

}  // namespace

std::size_t memory_needed(const danger::Grid& grid, std::size_t bytes_per_value,
                          const Settings& settings) {
  const std::size_t arrays = num_arrays(settings.steps) + (settings.tube == Tube::highest ? 1 : 0);
  const std::size_t scratch = scratch_needed(grid) * static_cast<std::size_t>(settings.threads);
  return (arrays * (danger::num_cells(grid) + readable_beyond) + scratch) * bytes_per_value;
}

template <class Real>
Solver<Real>::Solver(const danger::Grid& grid, Flow<Real> flow, std::span<const Real> h,
                     const Settings& settings)
    : grid_(grid), flow_(std::move(flow)), settings_(settings) {
  expects(!danger::broken_rule(grid), "grid breaks no rule");
  cells_ = danger::num_cells(grid);
  expects(h.size() == cells_, "h has one value per cell");
  expects(flow_.dimensions == grid.axes.size(), "the flow is of this grid");
  expects(std::isfinite(flow_.crossings_per_second) && flow_.crossings_per_second >= 0.0,
          "speeds are numbers");
  expects(settings.cfl > 0.0 && settings.cfl <= 1.0, "0 < cfl <= 1");
  expects(settings.threads >= 1, "at least one thread");
  expects(std::all_of(h.begin(), h.end(), [](Real x) { return std::isfinite(x); }),
          "h is finite everywhere");
  for (std::size_t d = 0; d < grid.axes.size(); ++d) {
    steepness_[d] = steepness(grid, h, d);
  }
  now_ = readable<Real>(cells_);
  std::copy(h.begin(), h.end(), now_.begin());
  if (settings.tube == Tube::highest) {
    h_ = now_;
  }
  first_ = readable<Real>(cells_);
  if (settings.steps != Steps::euler) {
    second_ = readable<Real>(cells_);
  }
  scratch_.resize(scratch_needed(grid) * static_cast<std::size_t>(settings.threads));
  longest_step_ = flow_.crossings_per_second > 0.0 ? settings.cfl / flow_.crossings_per_second
                                                   : std::numeric_limits<double>::infinity();
}

template <class Real>
void Solver<Real>::resume(double tau, std::span<const Real> values) {
  expects(std::isfinite(tau) && tau >= 0.0, "tau >= 0");
  expects(values.size() == cells_, "one value per cell");
  std::copy(values.begin(), values.end(), now_.begin());
  time_ = tau;
}

template <class Real>
Swept Solver<Real>::stage(const std::vector<Real>& values, std::vector<Real>& out, double keep,
                          double dt) {
  const std::size_t rows = cells_ / static_cast<std::size_t>(grid_.axes[0].points);
  // Enough parts to even out what the machine does besides; each of whole rows.
  const auto threads = static_cast<std::size_t>(settings_.threads);
  const std::size_t parts = std::min(rows, threads == 1 ? 1 : threads * 16);
  std::vector<Swept> swept(parts);
  std::exception_ptr thrown;  // by the system: it must not leave the parallel region
#pragma omp parallel num_threads(settings_.threads)
  {
#ifdef _OPENMP
    const auto thread = static_cast<std::size_t>(omp_get_thread_num());
#else
    const std::size_t thread = 0;
#endif
#pragma omp for schedule(dynamic)
    for (std::size_t part = 0; part < parts; ++part) {
      try {
        swept[part] = flow_.sweep({.values = values.data(),
                                   .old = now_.data(),
                                   .h = h_.data(),
                                   .out = out.data(),
                                   .keep = keep,
                                   .dt = dt,
                                   .tube = settings_.tube,
                                   .first_row = rows * part / parts,
                                   .end_row = rows * (part + 1) / parts,
                                   .steepness = steepness_,
                                   .scratch = scratch_.data() + thread * scratch_needed(grid_)});
      } catch (...) {
#pragma omp critical(saca_reach_thrown)
        thrown = std::current_exception();
      }
    }
  }
  if (thrown) {
    std::rethrow_exception(thrown);
  }
  Swept all;
  for (const Swept& part : swept) {
    all.greatest_change = std::max(all.greatest_change, part.greatest_change);
    if (!all.broken_cell) {
      all.broken_cell = part.broken_cell;
    }
  }
  return all;
}

template <class Real>
Result<double> Solver<Real>::step(double until) {
  expects(until > time_, "until > time()");
  const double rest = until - time_;
  const bool last = rest <= longest_step_ * (1.0 + 1e-9);
  const double dt = last ? rest : std::min(longest_step_, 0.5 * rest);

  const auto broken = [&](std::size_t cell) {
    return Error{Error::Code::out_of_range,
                 fmt::format("the value is no number after {:.4g} s at cell {} ({})", time_ + dt,
                             cell, described(grid_, danger::state_at(grid_, cell)))};
  };
  struct Part {
    std::vector<Real>*from, *to;
    double keep;
  };
  // u1 = u + dt L(u); u2 = 3/4 u + 1/4 (u1 + dt L(u1)); u3 = 1/3 u + 2/3 (u2 + dt L(u2)); or
  // halves.
  const std::array<Part, 3> parts{
      {{&now_, &first_, 0.0},
       {&first_, &second_, settings_.steps == Steps::tvd_rk3 ? 0.75 : 0.5},
       {&second_, &first_, 1.0 / 3.0}}};
  const std::size_t stages = num_stages(settings_.steps);
  Swept swept;
  for (std::size_t s = 0; s < stages; ++s) {
    swept = stage(*parts[s].from, *parts[s].to, parts[s].keep, dt);
    if (swept.broken_cell) {
      return broken(*swept.broken_cell);
    }
  }
  std::swap(now_, *parts[stages - 1].to);
  time_ = last ? until : time_ + dt;
  greatest_rate_ = swept.greatest_change / dt;
  return dt;
}

template class Solver<float>;
template class Solver<double>;

}  // namespace saca::levelset
