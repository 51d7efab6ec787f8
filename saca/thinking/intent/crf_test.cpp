#include "saca/thinking/intent/crf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "saca/base/core/contract.h"

namespace saca::intent::crf_test {
namespace {

using testing::Each;

struct Problem {
  Crf crf;
  std::vector<Scores> emissions;
  std::vector<ClassSet> allowed;
};

/// Random scores; three transitions and one start are forbidden.
Problem random_problem(std::uint32_t seed, std::size_t length) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 1.5);
  std::uniform_int_distribution<int> sets(1, any_class);
  Problem problem;
  for (std::size_t k = 0; k < num_classes; ++k) {
    problem.crf.start[k] = normal(random);
    for (std::size_t j = 0; j < num_classes; ++j) {
      problem.crf.transition[k][j] = normal(random);
    }
  }
  problem.crf.start[5] = forbidden;
  problem.crf.transition[1][2] = problem.crf.transition[2][1] = forbidden;
  problem.crf.transition[4][5] = forbidden;
  problem.emissions.resize(length);
  problem.allowed.resize(length);
  for (std::size_t t = 0; t < length; ++t) {
    for (double& each : problem.emissions[t]) {
      each = normal(random);
    }
    problem.allowed[t] = static_cast<ClassSet>(sets(random) | only(0));  // M, M, ... is allowed
  }
  return problem;
}

double path_score(const Problem& p, const std::vector<std::size_t>& path) {
  double score = p.crf.start[path[0]] + p.emissions[0][path[0]];
  for (std::size_t t = 1; t < path.size(); ++t) {
    score += p.crf.transition[path[t - 1]][path[t]] + p.emissions[t][path[t]];
  }
  return score;
}

/// Calls `visit` with each of the 6^length paths.
void for_each_path(std::size_t length,
                   const std::function<void(const std::vector<std::size_t>&)>& visit) {
  std::vector<std::size_t> path(length, 0);
  for (;;) {
    visit(path);
    std::size_t t = 0;
    while (t < length && ++path[t] == num_classes) {
      path[t++] = 0;
    }
    if (t == length) {
      return;
    }
  }
}

bool keeps_to(const std::vector<std::size_t>& path, const std::vector<ClassSet>& allowed) {
  for (std::size_t t = 0; t < path.size(); ++t) {
    if ((allowed[t] & only(path[t])) == 0) {
      return false;
    }
  }
  return true;
}

TEST(Crf, PartitionAndMarginalsAreSumsOverAllPaths) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const Problem p = random_problem(seed, 5);
    double sum = 0.0;
    double allowed_sum = 0.0;
    std::vector<Scores> uses(5, Scores{});
    for_each_path(5, [&](const std::vector<std::size_t>& path) {
      const double weight = std::exp(path_score(p, path));
      sum += weight;
      allowed_sum += keeps_to(path, p.allowed) ? weight : 0.0;
      for (std::size_t t = 0; t < 5; ++t) {
        uses[t][path[t]] += weight;
      }
    });
    EXPECT_NEAR(log_partition(p.crf, p.emissions), std::log(sum), 1e-10);
    EXPECT_NEAR(log_partition(p.crf, p.emissions, p.allowed), std::log(allowed_sum), 1e-10);
    const std::vector<Scores> found = marginals(p.crf, p.emissions);
    for (std::size_t t = 0; t < 5; ++t) {
      for (std::size_t k = 0; k < num_classes; ++k) {
        EXPECT_NEAR(found[t][k], uses[t][k] / sum, 1e-10);
      }
    }
  }
}

TEST(Crf, ViterbiIsTheBestOfAllPaths) {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const Problem p = random_problem(seed, 5);
    double best = forbidden;
    std::vector<std::size_t> best_path;
    for_each_path(5, [&](const std::vector<std::size_t>& path) {
      if (path_score(p, path) > best) {
        best = path_score(p, path);
        best_path = path;
      }
    });
    const std::vector<std::uint8_t> found = viterbi(p.crf, p.emissions);
    EXPECT_EQ(std::vector<std::size_t>(found.begin(), found.end()), best_path);
  }
}

TEST(Crf, GradientsAreThoseOfFiniteDifferences) {
  constexpr double h = 1e-5;
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    Problem p = random_problem(seed, 7);
    const Likelihood exact = likelihood(p.crf, p.emissions, p.allowed);
    const auto slope = [&](double& parameter) {
      const double kept = parameter;
      parameter = kept + h;
      const double above = likelihood(p.crf, p.emissions, p.allowed).value;
      parameter = kept - h;
      const double below = likelihood(p.crf, p.emissions, p.allowed).value;
      parameter = kept;
      return (above - below) / (2.0 * h);
    };
    constexpr double tolerance = 1e-8;  // h^2 times a third derivative of the order of 1, rounding
    for (std::size_t k = 0; k < num_classes; ++k) {
      for (std::size_t t = 0; t < 7; ++t) {
        EXPECT_NEAR(exact.emissions[t][k], slope(p.emissions[t][k]), tolerance);
      }
      for (std::size_t j = 0; j < num_classes; ++j) {
        if (p.crf.transition[k][j] == forbidden) {
          EXPECT_EQ(exact.crf.transition[k][j], 0.0);
        } else {
          EXPECT_NEAR(exact.crf.transition[k][j], slope(p.crf.transition[k][j]), tolerance);
        }
      }
      if (p.crf.start[k] != forbidden) {
        EXPECT_NEAR(exact.crf.start[k], slope(p.crf.start[k]), tolerance);
      }
    }
  }
}

TEST(Crf, NothingKnownOfAPathIsCertain) {
  const Problem p = random_problem(4, 6);
  const std::vector<ClassSet> anything(6, any_class);
  const Likelihood found = likelihood(p.crf, p.emissions, anything);
  EXPECT_NEAR(found.value, 0.0, 1e-12);
  for (const Scores& each : found.emissions) {
    EXPECT_THAT(each, Each(testing::DoubleNear(0.0, 1e-12)));
  }
}

TEST(Crf, NeverUsesWhatIsForbidden) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const Problem p = random_problem(seed, 40);
    const std::vector<std::uint8_t> path = viterbi(p.crf, p.emissions);
    EXPECT_NE(path[0], 5);
    for (std::size_t t = 1; t < path.size(); ++t) {
      EXPECT_GT(p.crf.transition[path[t - 1]][path[t]], forbidden);
    }
  }
}

TEST(Crf, SurvivesScoresOfThousands) {
  Problem p = random_problem(2, 50);
  for (Scores& each : p.emissions) {
    for (double& score : each) {
      score *= 1e3;
    }
  }
  for (const Scores& each : marginals(p.crf, p.emissions)) {
    double sum = 0.0;
    for (const double probability : each) {
      EXPECT_GE(probability, 0.0);
      sum += probability;
    }
    EXPECT_NEAR(sum, 1.0, 1e-6);
  }
}

TEST(Crf, RefusesChainsWithoutAPath) {
  Problem p = random_problem(1, 3);
  p.allowed[1] = 0;
  EXPECT_THROW((void)likelihood(p.crf, p.emissions, p.allowed), ContractViolation);
  EXPECT_THROW((void)marginals(p.crf, {}), ContractViolation);
  EXPECT_EQ(log_partition(p.crf, p.emissions, p.allowed), forbidden);
}

TEST(CrfFilter, AtEachInstantIsTheMarginalOfTheChainSoFar) {
  const Problem p = random_problem(3, 30);
  CrfFilter filter;
  for (std::size_t t = 0; t < p.emissions.size(); ++t) {
    const Scores& now = filter.step(p.crf, p.emissions[t]);
    const Scores expected = marginals(p.crf, std::span(p.emissions).first(t + 1)).back();
    for (std::size_t k = 0; k < num_classes; ++k) {
      EXPECT_NEAR(now[k], expected[k], 1e-10);
    }
  }
  filter.reset();
  EXPECT_NEAR(filter.step(p.crf, p.emissions[0])[1],
              marginals(p.crf, std::span(p.emissions).first(1))[0][1], 1e-12);
}

}  // namespace
}  // namespace saca::intent::crf_test
