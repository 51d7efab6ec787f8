#include "saca/eval/choices.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "saca/core/contract.h"

namespace saca::eval {
namespace {

using manoeuvre::PolicyId;

constexpr double least_probability = 1e-12;

double log_of(double probability) {
  return std::log(std::max(probability, least_probability));
}

PolicyId carried_out(const Finding& finding, PolicyId choice) {
  return finding.harm[manoeuvre::index(choice)] ? choice : PolicyId::aeb;
}

/// d log_loss / d(1 / temperature), which rises: mean log under the tempered less log of the
/// best's.
double slope(std::span<const Finding> findings, std::span<const Probabilities> said,
             double temperature) {
  double sum = 0.0;
  for (std::size_t i = 0; i < said.size(); ++i) {
    const Probabilities soft = tempered(said[i], temperature);
    for (std::size_t k = 0; k < soft.size(); ++k) {
      sum += soft[k] * log_of(said[i][k]);
    }
    sum -= log_of(said[i][manoeuvre::index(findings[i].best)]);
  }
  return sum;
}

}  // namespace

ChoiceFigures figures_of(std::span<const Finding> findings, std::span<const PolicyId> choices) {
  expects(findings.size() == choices.size() && findings.size() >= 2, "two choices at least");
  ChoiceFigures figures{.count = static_cast<int>(findings.size())};
  std::vector<double> harms;
  std::vector<double> regrets;
  int right = 0;
  int contacts = 0;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const Finding& finding = findings[i];
    expects(finding.time.has_value(), "it triggered");
    const PolicyId done = carried_out(finding, choices[i]);
    const double harm = finding.harm[manoeuvre::index(done)].value();
    harms.push_back(harm);
    regrets.push_back(harm - finding.harm[manoeuvre::index(finding.best)].value());
    right += done == finding.best ? 1 : 0;
    contacts += finding.contact[manoeuvre::index(done)] ? 1 : 0;
    if (finding.best == PolicyId::no_intervention) {
      ++figures.quiet;
      figures.needless += done == finding.best ? 0 : 1;
    }
  }
  figures.right = proportion(right, figures.count);
  figures.contact = proportion(contacts, figures.count);
  figures.harm = outcome::mean(harms);
  figures.regret = outcome::mean(regrets);
  return figures;
}

Probabilities tempered(const Probabilities& probabilities, double temperature) {
  expects(temperature > 0.0, "temperature > 0");
  const double top = *std::max_element(probabilities.begin(), probabilities.end());
  Probabilities soft{};
  double sum = 0.0;
  for (std::size_t k = 0; k < soft.size(); ++k) {
    soft[k] = std::exp((log_of(probabilities[k]) - log_of(top)) / temperature);
    sum += soft[k];
  }
  for (double& p : soft) {
    p /= sum;
  }
  return soft;
}

double log_loss(std::span<const Finding> findings, std::span<const Probabilities> said,
                double temperature) {
  expects(findings.size() == said.size() && !said.empty(), "answers of each encounter");
  double sum = 0.0;
  for (std::size_t i = 0; i < said.size(); ++i) {
    sum -= log_of(tempered(said[i], temperature)[manoeuvre::index(findings[i].best)]);
  }
  return sum / static_cast<double>(said.size());
}

double best_temperature(std::span<const Finding> findings, std::span<const Probabilities> said) {
  expects(findings.size() == said.size() && !said.empty(), "answers of each encounter");
  double softest = 1.0 / 20.0;  // of 1 / temperature
  double sharpest = 20.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = std::sqrt(softest * sharpest);
    (slope(findings, said, 1.0 / middle) > 0.0 ? sharpest : softest) = middle;
  }
  return 1.0 / std::sqrt(softest * sharpest);
}

}  // namespace saca::eval
