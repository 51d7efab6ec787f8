#include "saca/lab/intention_scoring/score.h"

#include <algorithm>
#include <cmath>

#include "saca/base/core/contract.h"

namespace saca::intention_scoring {
namespace {

/// Of single precision, in which models work, a few roundings [-].
constexpr double sum_tolerance = 1e-4;

std::size_t predicted_as(const Confusion& confusion, std::size_t of) {
  std::size_t sum = 0;
  for (const auto& row : confusion.counts) {
    sum += row.at(of);
  }
  return sum;
}

double share(std::size_t part, std::size_t whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

void add(Reliability& bins, double probability, bool right) {
  const double place = probability * static_cast<double>(num_bins);
  ReliabilityBin& bin = bins.at(std::min(static_cast<std::size_t>(place), num_bins - 1));
  ++bin.count;
  bin.probability += probability;
  bin.right += right ? 1.0 : 0.0;
}

void add(Reliability& bins, const Reliability& other) {
  for (std::size_t i = 0; i < num_bins; ++i) {
    bins.at(i).count += other.at(i).count;
    bins.at(i).probability += other.at(i).probability;
    bins.at(i).right += other.at(i).right;
  }
}

void add(Tally& tally, const ClassProbabilities& predicted, std::size_t named, std::size_t truth) {
  const std::size_t top = likeliest_class(predicted);
  ++tally.confusion.counts.at(truth).at(named);
  add(tally.top, predicted.at(top), top == truth);
  for (std::size_t c = 0; c < num_vehicle_classes; ++c) {
    const double is_so = c == truth ? 1.0 : 0.0;
    add(tally.of_class.at(c), predicted.at(c), c == truth);
    tally.brier += (predicted.at(c) - is_so) * (predicted.at(c) - is_so);
  }
  tally.log_loss -= std::log(std::max(predicted.at(truth), least_probability));
}

/// One head's, without asking whether all is whole.
void add(Tally& tally, const Sequence& sequence, const Forecasts& forecasts, std::size_t head) {
  each_judged_frame(sequence, head, [&](std::size_t t, std::size_t later) {
    add(tally, forecasts.at.at(head)[t], forecasts.named(head, t), sequence.labels[later]);
  });
}

std::optional<double> mean(double sum, std::size_t count) {
  return count == 0 ? std::nullopt : std::optional<double>(sum / static_cast<double>(count));
}

}  // namespace

bool is_distribution(const ClassProbabilities& probabilities) {
  double sum = 0.0;
  for (const double p : probabilities) {
    if (!(p >= 0.0 && p <= 1.0)) {
      return false;
    }
    sum += p;
  }
  return std::abs(sum - 1.0) <= sum_tolerance;
}

std::size_t likeliest_class(const ClassProbabilities& probabilities) {
  return static_cast<std::size_t>(std::max_element(probabilities.begin(), probabilities.end()) -
                                  probabilities.begin());
}

std::vector<std::uint8_t> Forecasts::named(std::size_t head) const {
  std::vector<std::uint8_t> classes;
  classes.reserve(at.at(head).size());
  for (const ClassProbabilities& one : at.at(head)) {
    classes.push_back(static_cast<std::uint8_t>(intent::named_class(naming.at(head), one)));
  }
  return classes;
}

void expect_whole(const Sequence& sequence) {
  const std::size_t frames = sequence.observations.size();
  expects(sequence.labels.size() == frames, "a label for each observation");
  expects(sequence.scored.size() == frames, "whether it is scored, for each observation");
  expects(std::all_of(sequence.labels.begin(), sequence.labels.end(),
                      [](std::uint8_t label) { return label < num_vehicle_classes; }),
          "labels are classes of vehicles");
}

void expect_forecasts_of(const Sequence& sequence, const Forecasts& forecasts) {
  for (const auto& of_head : forecasts.at) {
    expects(of_head.size() == sequence.observations.size(), "a forecast for each observation");
    expects(std::all_of(of_head.begin(), of_head.end(), is_distribution),
            "probabilities in [0, 1] that sum to 1");
  }
}

std::size_t Confusion::truly(std::size_t of) const {
  std::size_t sum = 0;
  for (const std::size_t count : counts.at(of)) {
    sum += count;
  }
  return sum;
}

std::size_t Confusion::total() const {
  std::size_t sum = 0;
  for (std::size_t c = 0; c < num_vehicle_classes; ++c) {
    sum += truly(c);
  }
  return sum;
}

std::optional<double> Confusion::recall(std::size_t of) const {
  const std::size_t there = truly(of);
  return there == 0 ? std::nullopt : std::optional<double>(share(counts.at(of).at(of), there));
}

std::optional<double> Confusion::precision(std::size_t of) const {
  const std::size_t called = predicted_as(*this, of);
  return called == 0 ? std::nullopt : std::optional<double>(share(counts.at(of).at(of), called));
}

std::optional<double> Confusion::f1(std::size_t of) const {
  const std::size_t either = truly(of) + predicted_as(*this, of);
  return either == 0 ? std::nullopt
                     : std::optional<double>(share(2 * counts.at(of).at(of), either));
}

std::optional<double> Confusion::macro_f1(std::span<const std::size_t> classes) const {
  double sum = 0.0;
  std::size_t there = 0;
  for (const std::size_t of : classes) {
    if (truly(of) > 0) {
      sum += *f1(of);
      ++there;
    }
  }
  return mean(sum, there);
}

std::optional<double> calibration_error(const Reliability& bins) {
  std::size_t count = 0;
  double sum = 0.0;
  for (const ReliabilityBin& bin : bins) {
    count += bin.count;
    sum += std::abs(bin.probability - bin.right);
  }
  return mean(sum, count);
}

Tally& Tally::operator+=(const Tally& other) {
  for (std::size_t truth = 0; truth < num_vehicle_classes; ++truth) {
    for (std::size_t predicted = 0; predicted < num_vehicle_classes; ++predicted) {
      confusion.counts.at(truth).at(predicted) += other.confusion.counts.at(truth).at(predicted);
    }
    add(of_class.at(truth), other.of_class.at(truth));
  }
  add(top, other.top);
  log_loss += other.log_loss;
  brier += other.brier;
  return *this;
}

std::optional<double> Tally::top_calibration_error() const {
  return calibration_error(top);
}

std::optional<double> Tally::classwise_calibration_error() const {
  double sum = 0.0;
  for (const Reliability& bins : of_class) {
    const auto error = calibration_error(bins);
    if (!error) {
      return std::nullopt;
    }
    sum += *error;
  }
  return sum / static_cast<double>(num_vehicle_classes);
}

std::optional<double> Tally::mean_log_loss() const {
  return mean(log_loss, confusion.total());
}
std::optional<double> Tally::mean_brier() const {
  return mean(brier, confusion.total());
}

Tally tally(const Sequence& sequence, const Forecasts& forecasts, std::size_t head) {
  expects(head < num_heads, "head < num_heads");
  expect_whole(sequence);
  expect_forecasts_of(sequence, forecasts);
  Tally sum;
  add(sum, sequence, forecasts, head);
  return sum;
}

std::vector<std::string> groups_of(std::span<const Sequence> sequences) {
  std::vector<std::string> groups;
  for (const Sequence& sequence : sequences) {
    groups.push_back(sequence.group);
  }
  std::sort(groups.begin(), groups.end());
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  return groups;
}

std::vector<Tally> group_tallies(std::span<const Sequence> sequences,
                                 std::span<const Forecasts> forecasts, std::size_t head) {
  expects(sequences.size() == forecasts.size(), "forecasts of each sequence");
  expects(head < num_heads, "head < num_heads");
  const std::vector<std::string> groups = groups_of(sequences);
  std::vector<Tally> tallies(groups.size());
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    const auto group = std::lower_bound(groups.begin(), groups.end(), sequences[i].group);
    tallies[static_cast<std::size_t>(group - groups.begin())] +=
        tally(sequences[i], forecasts[i], head);
  }
  return tallies;
}

}  // namespace saca::intention_scoring
