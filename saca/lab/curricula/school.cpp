#include "saca/lab/curricula/school.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "saca/base/core/parallel.h"
#include "saca/lab/curricula/episodes_line.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/long_work/resumable_work.h"

namespace saca::curricula {

namespace fs = std::filesystem;
using eval::Curriculum;
using eval::Episodes;

School::School(std::vector<Curriculum> curricula, EncounterAt encounter_at, std::uint64_t count,
               int threads)
    : curricula_(std::move(curricula)),
      encounter_at_(std::move(encounter_at)),
      count_(count),
      threads_(threads) {}

std::vector<std::uint64_t> School::numbers_of(std::uint64_t number) const {
  std::vector<std::uint64_t> numbers(curricula_.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    numbers[k] = k * count_ + number;
  }
  return numbers;
}

Episodes School::teach(std::uint64_t number) {
  const std::vector<std::uint64_t> numbers = numbers_of(number);
  Episodes episodes;
  episodes.of.resize(curricula_.size());
  in_parallel(curricula_.size(), threads_, [&](std::size_t k) {
    const auto encounter = encounter_at_(numbers[k]);
    if (encounter.has_value()) {
      episodes.of[k] = curricula_[k].play(encounter.value());
    } else {
      episodes.of[k].row.number = numbers[k];
      episodes.of[k].row.family = "?";
      episodes.of[k].row.fault = encounter.error().message;
    }
  });
  if (auto problem = learn(episodes)) {
    failure_ = std::move(problem);
  }
  return episodes;
}

std::optional<Error> School::learn(Episodes& episodes) {
  std::vector<std::optional<Error>> problems(curricula_.size());
  episodes.size.resize(curricula_.size());
  in_parallel(curricula_.size(), threads_, [&](std::size_t k) {
    problems[k] = curricula_[k].learn(episodes.of[k]);
    episodes.size[k] = curricula_[k].sizes();
  });
  const auto first = std::find_if(problems.begin(), problems.end(),
                                  [](const auto& problem) { return problem.has_value(); });
  return first == problems.end() ? std::nullopt : std::move(*first);
}

Result<std::vector<Curriculum>> begin_curricula(const eval::CurriculumSetup& first,
                                                std::span<const memory::Case> start,
                                                const fs::path& folder, int seeds) {
  std::vector<Curriculum> curricula;
  for (int k = 0; k < seeds; ++k) {
    const fs::path banks = folder / fmt::format("seed-{}", k + 1);
    if (auto problem = long_work::make_folder_of(banks / "bank")) {
      return *std::move(problem);
    }
    eval::CurriculumSetup setup = first;
    setup.seed += static_cast<std::uint64_t>(k);
    auto curriculum = Curriculum::begin(std::move(setup), start, banks);
    if (!curriculum.has_value()) {
      return curriculum.error();
    }
    curricula.push_back(std::move(curriculum).value());
  }
  return curricula;
}

Result<std::optional<std::vector<Episodes>>> taught_by(School& school,
                                                       const SchoolJournal& journal) {
  return long_work::rows_of<Episodes>(
      {.journal = journal.file.string(),
       .title = journal.title,
       .progress = "learn",
       .unit = "encounters of each seed",
       .count = school.count(),
       .display = journal.display,
       .threads = 1,  // one after the other: seeds are worked on at the same time
       .row = [&](std::size_t number) { return school.teach(number); },
       .line_of = [](const Episodes& episodes) { return line_of(episodes); },
       .row_from = [&, number =
                           std::uint64_t{0}](const std::string& line) mutable -> Result<Episodes> {
         auto read = episodes_from(line, school.numbers_of(number++));
         if (!read.has_value()) {
           return read;
         }
         Episodes episodes = std::move(read).value();
         if (auto problem = school.learn(episodes)) {
           return *std::move(problem);
         }
         return episodes;
       },
       .spoilt_by_interrupt = journal.spoilt_by_interrupt,
       .failure = [&]() -> std::optional<Error> {
         const auto failure = journal.failure();
         return failure ? failure : school.failure();
       }});
}

}  // namespace saca::curricula
