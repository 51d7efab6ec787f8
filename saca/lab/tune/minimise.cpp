#include "saca/lab/tune/minimise.h"

#include <fmt/core.h>

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <nlopt.hpp>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/fnv.h"
#include "saca/base/core/journal.h"

namespace saca::tune {
namespace {

namespace fs = std::filesystem;

/// The costs that a journal remembers, in the order in which they were asked for.
Result<std::vector<double>> costs_of(const Journal& journal, const fs::path& path) {
  std::vector<double> costs;
  for (const std::string& line : journal.lines()) {
    char* end = nullptr;
    const double cost = std::strtod(line.c_str(), &end);
    if (end == line.c_str() || *end != '\0') {
      return Error{Error::Code::malformed, fmt::format("{}: line {}: want a cost, got \"{}\"",
                                                       path.string(), costs.size() + 2, line)};
    }
    costs.push_back(cost);
  }
  return costs;
}

/// The cost as the optimiser sees it: remembered, or worked out and remembered.
class MemoisedCost {
 public:
  MemoisedCost(const Problem& problem, const Journal& journal, std::vector<double> known,
               const std::function<bool(const Progress&)>& look)
      : problem_(problem), journal_(journal), known_(std::move(known)), look_(look) {}

  double operator()(const std::vector<double>& x) {
    const auto i = static_cast<std::size_t>(num_evaluations_);
    const bool known = i < known_.size();
    const double cost = known ? known_[i] : problem_.cost(x);
    if (!known && !journal_.add(fmt::format("{:.17g}", cost))) {
      written_ = false;
      throw nlopt::forced_stop();
    }
    ++num_evaluations_;
    if (!best_ || cost < best_->cost) {
      best_ = Minimum{.at = x, .cost = cost};
    }
    best_->evaluations = num_evaluations_;
    if (!look_({num_evaluations_, best_->cost, known})) {
      stopped_ = true;
      throw nlopt::forced_stop();
    }
    return cost;
  }

  [[nodiscard]] const std::optional<Minimum>& best() const { return best_; }
  [[nodiscard]] bool stopped() const { return stopped_; }
  [[nodiscard]] bool written() const { return written_; }
  [[nodiscard]] int num_evaluations() const { return num_evaluations_; }

 private:
  const Problem& problem_;
  const Journal& journal_;
  std::vector<double> known_;
  const std::function<bool(const Progress&)>& look_;
  std::optional<Minimum> best_;
  int num_evaluations_ = 0;
  bool stopped_ = false;
  bool written_ = true;
};

/// Of everything but the cost: the same search asks for the same numbers.
std::uint64_t digest(const Problem& problem) {
  Fnv hash;
  for (const auto* numbers : {&problem.low, &problem.high, &problem.start}) {
    for (const double number : *numbers) {
      hash.add(std::bit_cast<std::uint64_t>(number));
    }
  }
  return hash.value();
}

double evaluate(const std::vector<double>& x, std::vector<double>& /*gradient*/, void* watched) {
  return (*static_cast<MemoisedCost*>(watched))(x);
}

void search(nlopt::algorithm algorithm, const Problem& problem, std::vector<double> start,
            int evaluations, MemoisedCost& watched) {
  nlopt::opt optimiser(algorithm, static_cast<unsigned>(start.size()));
  optimiser.set_lower_bounds(problem.low);
  optimiser.set_upper_bounds(problem.high);
  optimiser.set_min_objective(evaluate, &watched);
  optimiser.set_maxeval(evaluations);
  optimiser.set_ftol_rel(1e-6);
  double cost = 0.0;
  try {
    (void)optimiser.optimize(start, cost);
  } catch (const nlopt::forced_stop&) {
    // `watched` knows why.
  } catch (const nlopt::roundoff_limited&) {
    // As good as the numbers allow.
  }
}

}  // namespace

Result<std::optional<Minimum>> minimise(const Problem& problem, const Effort& effort,
                                        const fs::path& journal,
                                        const std::function<bool(const Progress&)>& look) {
  expects(!problem.start.empty() && problem.low.size() == problem.start.size() &&
              problem.high.size() == problem.start.size() && effort.evaluations > 0,
          "one low, high and start for each number, and evaluations > 0");
  auto opened = Journal::open(
      journal, fmt::format("{}, box and start {:016x}, {} evaluations, seed {}", problem.name,
                           digest(problem), effort.evaluations, effort.seed));
  if (!opened.has_value()) {
    return opened.error();
  }
  const Journal written = std::move(opened).value();
  auto known = costs_of(written, journal);
  if (!known.has_value()) {
    return known.error();
  }
  MemoisedCost watched(problem, written, std::move(known).value(), look);
  nlopt::srand(effort.seed);
  search(nlopt::GN_CRS2_LM, problem, problem.start, effort.evaluations - effort.evaluations / 5,
         watched);
  const auto goes_on = [&] { return !watched.stopped() && watched.written(); };
  const int left = effort.evaluations - watched.num_evaluations();
  if (goes_on() && left > 0) {
    search(nlopt::LN_SBPLX, problem, watched.best()->at, left, watched);
  }
  if (!watched.written()) {
    return Error{Error::Code::unwritable, journal.string() + ": cannot be added to"};
  }
  return watched.stopped() ? std::nullopt : watched.best();
}

}  // namespace saca::tune
