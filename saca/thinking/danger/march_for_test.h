#pragma once

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "saca/lab/levelset/solver.h"

namespace saca::danger {

/// Steps on to a time [s]. Where no step can be taken, the test fails.
template <class Real>
void march(levelset::Solver<Real>& solver, double until) {
  while (solver.time() < until) {
    const auto taken = solver.step(until);
    ASSERT_TRUE(taken.has_value()) << taken.error().message;
  }
  EXPECT_EQ(solver.time(), until);
}

/// Values at a horizon [s], from h at time 0.
template <class Real>
std::vector<Real> marched(const Grid& grid, levelset::Flow<Real> flow, const std::vector<Real>& h,
                          double horizon, const levelset::Settings& settings = {}) {
  levelset::Solver<Real> solver(grid, std::move(flow), h, settings);
  march(solver, horizon);
  return {solver.values().begin(), solver.values().end()};
}

}  // namespace saca::danger
