#include "saca/tune/minimise.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <nlopt.hpp>
#include <sstream>
#include <utility>

#include "saca/core/contract.h"
#include "saca/core/file.h"
#include "saca/core/fnv.h"

namespace saca::tune {
namespace {

namespace fs = std::filesystem;

/// What was worked out, one cost a line, in the order in which it was asked for. A line that a kill
/// cut short is dropped.
class Journal {
 public:
  static Result<Journal> open(const fs::path& path, const std::string& title) {
    Journal journal;
    const std::string first = title + "\n";
    std::string text;
    if (fs::exists(path)) {
      auto read = read_file(path);
      if (!read.has_value()) {
        return read.error();
      }
      text = read.value().substr(0, read.value().rfind('\n') + 1);
    }
    if (!text.empty() && !text.starts_with(first)) {
      return Error{Error::Code::malformed,
                   fmt::format("{}: is the journal of \"{}\", not of \"{}\": remove it, or ask for "
                               "what it was begun with",
                               path.string(), text.substr(0, text.find('\n')), title)};
    }
    std::istringstream lines(text.substr(std::min(text.size(), first.size())));
    for (std::string line; std::getline(lines, line);) {
      char* end = nullptr;
      const double cost = std::strtod(line.c_str(), &end);
      if (end == line.c_str() || *end != '\0') {
        return Error{Error::Code::malformed,
                     fmt::format("{}: line {}: want a cost, got \"{}\"", path.string(),
                                 journal.costs_.size() + 2, line)};
      }
      journal.costs_.push_back(cost);
    }
    const std::string whole = text.empty() ? first : text;
    if (auto problem = write_file(path, whole)) {
      return *problem;
    }
    journal.file_ = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (journal.file_ < 0) {
      return Error{Error::Code::unwritable, path.string() + ": " + std::strerror(errno)};
    }
    return journal;
  }

  Journal(Journal&& other) noexcept
      : costs_(std::move(other.costs_)), file_(std::exchange(other.file_, -1)) {}
  Journal& operator=(Journal&&) = delete;
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  ~Journal() {
    if (file_ >= 0) {
      ::close(file_);
    }
  }

  [[nodiscard]] std::optional<double> cost(std::size_t i) const {
    return i < costs_.size() ? std::optional(costs_[i]) : std::nullopt;
  }

  /// False when the disk did not take it.
  [[nodiscard]] bool add(double cost) const {
    const std::string line = fmt::format("{:.17g}\n", cost);
    return ::write(file_, line.data(), line.size()) == static_cast<ssize_t>(line.size());
  }

 private:
  Journal() = default;
  std::vector<double> costs_;
  int file_ = -1;
};

/// The cost as the optimiser sees it: remembered, or worked out and remembered.
class Watched {
 public:
  Watched(const Problem& problem, const Journal& journal,
          const std::function<bool(const Progress&)>& look)
      : problem_(problem), journal_(journal), look_(look) {}

  double operator()(const std::vector<double>& x) {
    const auto i = static_cast<std::size_t>(num_evaluations_);
    const std::optional<double> known = journal_.cost(i);
    const double cost = known ? *known : problem_.cost(x);
    if (!known && !journal_.add(cost)) {
      written_ = false;
      throw nlopt::forced_stop();
    }
    ++num_evaluations_;
    if (!best_ || cost < best_->cost) {
      best_ = Minimum{.at = x, .cost = cost};
    }
    best_->evaluations = num_evaluations_;
    if (!look_({num_evaluations_, best_->cost, known.has_value()})) {
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
  return (*static_cast<Watched*>(watched))(x);
}

void search(nlopt::algorithm algorithm, const Problem& problem, std::vector<double> start,
            int evaluations, Watched& watched) {
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
  Watched watched(problem, written, look);
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
