#include "saca/lab/eval/survey.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>

#include "saca/base/core/contract.h"
#include "saca/base/core/csv.h"
#include "saca/base/core/journal.h"
#include "saca/base/core/parallel.h"
#include "saca/base/core/percentile.h"
#include "saca/thinking/preview/preview.h"

namespace saca::eval {
namespace {

using manoeuvre::num_policies;
using manoeuvre::PolicyId;

constexpr std::string_view no_number = "-";
constexpr std::size_t batch = 64;  // encounters between two looks at who watches

std::string word_of(const std::optional<double>& number) {
  return number ? fmt::format("{:.17g}", *number) : std::string(no_number);
}

// False when the word is neither a number nor missing.
bool read_word(std::string_view word, std::optional<double>& number) {
  number = finite_number(word);
  return number.has_value() || word == no_number;
}

/// What a journal remembers, in order.
Result<std::vector<Finding>> remembered(const Journal& journal, const std::string& path,
                                        int count) {
  std::vector<Finding> found;
  for (const std::string& line : journal.lines()) {
    const auto finding = finding_from(line);
    if (!finding || finding->number != found.size()) {
      return Error{Error::Code::malformed,
                   fmt::format("{}: line {}: want the finding of encounter {}, got \"{}\"", path,
                               found.size() + 2, found.size(), line)};
    }
    found.push_back(*finding);
  }
  found.resize(std::min(found.size(), static_cast<std::size_t>(count)));
  return found;
}

/// The next few. The number of threads changes nothing.
Result<std::vector<Finding>> look_on(const SurveyWork& work, std::size_t from, std::size_t to) {
  std::vector<scenario::Scenario> scenarios(to - from);
  std::vector<std::optional<Error>> problems(to - from);
  in_parallel(scenarios.size(), work.threads, [&](std::size_t i) {
    const auto sample = work.source->sample(from + i);
    if (sample.has_value()) {
      scenarios[i] = sample.value().scenario;
    } else {
      problems[i] = sample.error();
    }
  });
  for (const auto& problem : problems) {
    if (problem) {
      return *problem;
    }
  }
  std::vector<Finding> next = look_into(scenarios, *work.car, *work.harm, work.threads);
  for (std::size_t i = 0; i < next.size(); ++i) {
    next[i].number = from + i;
    next[i].family = work.source->family_of(from + i);
  }
  return next;
}

}  // namespace

Finding finding_of(double time, const encounter::Hindsights& tried) {
  Finding finding;
  finding.time = time;
  preview::AllFacts facts;
  for (std::size_t i = 0; i < num_policies; ++i) {
    facts[i] = tried[i].facts;
    if (facts[i].drivable()) {
      finding.harm[i] = facts[i].outcome().harm;
      finding.contact[i] = facts[i].outcome().contact.has_value();
    }
  }
  finding.best = preview::best_by_forecast(facts);
  return finding;
}

std::vector<Finding> look_into(std::span<const scenario::Scenario> scenarios,
                               const manoeuvre::Car& car, const collision::HarmModel& harm,
                               int threads) {
  std::vector<std::optional<DecisionPoint>> triggers(scenarios.size());
  in_parallel(scenarios.size(), threads,
              [&](std::size_t i) { triggers[i] = decision_point_at_trigger(scenarios[i], car); });
  const auto tried = tried_from(triggers, car, harm, threads);
  std::vector<Finding> findings(scenarios.size());
  for (std::size_t i = 0; i < tried.size(); ++i) {
    if (tried[i]) {
      findings[i] = finding_of(triggers[i]->scene.time, *tried[i]);
    }
  }
  return findings;
}

std::string line_of(const Finding& finding) {
  std::string line = fmt::format("{},{},{},{}", finding.family, finding.number,
                                 word_of(finding.time), manoeuvre::index(finding.best));
  for (std::size_t i = 0; i < num_policies; ++i) {
    line += fmt::format(",{},{}", word_of(finding.harm[i]), finding.contact[i] ? 1 : 0);
  }
  return line;
}

std::optional<Finding> finding_from(std::string_view line) {
  const std::vector<std::string_view> words = fields_of(line, ',');
  if (words.size() != 4 + 2 * num_policies) {
    return std::nullopt;
  }
  Finding finding;
  finding.family = words[0];
  const auto number =
      std::from_chars(words[1].data(), words[1].data() + words[1].size(), finding.number);
  const bool digit = words[3].size() == 1 && words[3][0] >= '0' && words[3][0] <= '9';
  const auto policy = manoeuvre::policy_from(digit ? words[3][0] - '0' : -1);
  if (number.ec != std::errc() || number.ptr != words[1].data() + words[1].size() || !policy ||
      !read_word(words[2], finding.time)) {
    return std::nullopt;
  }
  finding.best = *policy;
  for (std::size_t i = 0; i < num_policies; ++i) {
    const std::string_view contact = words[5 + 2 * i];
    if (!read_word(words[4 + 2 * i], finding.harm[i]) || (contact != "0" && contact != "1")) {
      return std::nullopt;
    }
    finding.contact[i] = contact == "1";
  }
  // Braking and doing nothing can always be tried.
  const bool tried = finding.harm[manoeuvre::index(PolicyId::aeb)] &&
                     finding.harm[manoeuvre::index(PolicyId::no_intervention)];
  return finding.time.has_value() == tried ? std::optional(finding) : std::nullopt;
}

Result<std::optional<std::vector<Finding>>> survey(const SurveyWork& work,
                                                   const SurveyWatch& watch) {
  expects(work.source != nullptr && work.car != nullptr && work.harm != nullptr,
          "source, car and harm are given");
  expects(work.count >= 0, "count >= 0");
  const auto journal = Journal::open(work.journal, work.title);
  if (!journal.has_value()) {
    return journal.error();
  }
  auto known = remembered(journal.value(), work.journal.string(), work.count);
  if (!known.has_value()) {
    return known.error();
  }
  std::vector<Finding> found = std::move(known).value();
  const int before = static_cast<int>(found.size());
  const auto count = static_cast<std::size_t>(work.count);
  while (found.size() < count) {
    if (watch.is_interrupted()) {
      return std::optional<std::vector<Finding>>();
    }
    const auto next = look_on(work, found.size(), std::min(count, found.size() + batch));
    if (!next.has_value()) {
      return next.error();
    }
    for (const Finding& finding : next.value()) {
      if (!journal.value().add(line_of(finding))) {
        return Error{Error::Code::unwritable, work.journal.string() + ": cannot be added to"};
      }
      found.push_back(finding);
    }
    watch.progress(static_cast<int>(found.size()), before);
  }
  return std::optional(std::move(found));
}

Taught lesson_of(const Finding& finding) {
  if (!finding.time) {
    return {Lesson::never_triggers, std::nullopt, 0.0};
  }
  std::vector<std::pair<double, PolicyId>> harms;
  for (const PolicyId policy : manoeuvre::all_policies) {
    if (const auto& harm = finding.harm[manoeuvre::index(policy)]) {
      harms.emplace_back(*harm, policy);
    }
  }
  std::sort(harms.begin(), harms.end());
  const double nothing =
      collision::harm_class(finding.harm[manoeuvre::index(PolicyId::no_intervention)].value());
  const double least = collision::harm_class(harms.front().first);
  Taught taught;
  if (collision::harm_class(harms[1].first) > least) {
    taught.alone = harms.front().second;
    taught.margin = harms[1].first - harms.front().first;
  }
  taught.lesson = nothing == 0       ? Lesson::nothing_needed
                  : nothing == least ? Lesson::nothing_helps
                  : taught.alone     ? Lesson::one_alone
                                     : Lesson::several_as_good;
  return taught;
}

Balance balance(std::span<const Finding> findings) {
  Balance balance;
  std::array<std::vector<double>, num_policies> margins;
  for (const Finding& finding : findings) {
    ++balance.count;
    const Taught taught = lesson_of(finding);
    ++balance.lessons[static_cast<std::size_t>(taught.lesson)];
    if (finding.time) {
      ++balance.best[manoeuvre::index(finding.best)];
    }
    if (taught.alone) {
      ++balance.alone[manoeuvre::index(*taught.alone)];
      margins[manoeuvre::index(*taught.alone)].push_back(taught.margin);
    }
  }
  for (std::size_t i = 0; i < num_policies; ++i) {
    balance.margin[i] = margins[i].empty() ? 0.0 : percentile(margins[i], 0.5);
  }
  return balance;
}

}  // namespace saca::eval
