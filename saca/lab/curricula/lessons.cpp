#include "saca/lab/curricula/lessons.h"

#include <fmt/core.h>

#include <utility>

#include "saca/base/core/journal.h"
#include "saca/lab/banks/bank_files.h"
#include "saca/lab/curricula/school.h"
#include "saca/lab/long_work/folder_hold.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::curricula {

using installation::Installation;

namespace {

/// What memories know at the beginning: a bank, the shipped cases, or nothing.
Result<std::vector<memory::Case>> first_cases(const Installation& here,
                                              const LearnRequest& request) {
  if (request.empty_memory) {
    return std::vector<memory::Case>();
  }
  if (!request.from.thinking.memory.empty()) {
    auto bank = banks::read_bank(request.from.thinking.memory);
    if (!bank.has_value()) {
      return bank.error();
    }
    return std::move(bank).value().cases;
  }
  return banks::shipped_cases(here.root);
}

SchoolJournal journal_of(const Installation& here, const Lessons& lessons,
                         const LearnRequest& request) {
  const auto model = lessons.thinking->model_text();
  return {.file = journal_place(request),
          .title = fmt::format("saca {} {} of {}, from {}{}, with {:016x}", version_text(here),
                               command_text(request), lessons.encounters.what, lessons.digest.start,
                               model ? ", model: " + *model : "", lessons.digest.all),
          .display = here.display,
          .spoilt_by_interrupt = lessons.thinking->has_model(),
          .failure = [&lessons] { return lessons.thinking->failure(); }};
}

}  // namespace

Result<Lessons> open_lessons(const Installation& here, const LearnRequest& request) {
  Lessons lessons;
  suites::SuiteRequest from = request.from;
  from.count *= request.seeds;
  auto opened = suites::open_encounters(here, from, "learn");
  if (!opened.has_value()) {
    return opened.error();
  }
  suites::SuiteEncounters encounters = std::move(opened).value();
  lessons.count = static_cast<std::uint64_t>(encounters.count / request.seeds);
  if (lessons.count == 0) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: want an encounter for each of {} seeds, got {}",
                             request.from.name, request.seeds, encounters.count)};
  }
  auto planes = vehicle_study::open_planes(here, std::move(encounters.inputs));
  if (!planes.has_value()) {
    return planes.error();
  }
  lessons.encounters = std::move(encounters);
  lessons.planes = std::move(planes).value();
  Clock& clock = *lessons.planes->setup.clock;
  lessons.made_with = vehicle_study::made_with(*lessons.planes);
  auto thinking = suites::SuiteThinking::open({.memory = "", .model = request.from.thinking.model},
                                              suites::lockstep_models(here, clock),
                                              lessons.made_with, request.from.threads, clock);
  if (!thinking.has_value()) {
    return thinking.error();
  }
  lessons.thinking = std::move(thinking).value();
  auto start = first_cases(here, request);
  if (!start.has_value()) {
    return start.error();
  }
  lessons.start = std::move(start).value();
  lessons.digest = digest_of(lessons.start, lessons.made_with);
  return lessons;
}

std::filesystem::path journal_place(const LearnRequest& request) {
  return std::filesystem::path(request.folder) / "episodes.journal";
}

Result<std::optional<std::vector<eval::Episodes>>> taught(const Installation& here,
                                                          Lessons& lessons,
                                                          const LearnRequest& request) {
  const SchoolJournal journal = journal_of(here, lessons, request);
  if (auto problem = long_work::make_folder_of(journal.file)) {
    return *std::move(problem);
  }
  const auto hold = long_work::FolderHold::unless_held(journal.file.parent_path());
  if (!hold) {
    return Error{Error::Code::unwritable,
                 request.folder +
                     ": another program is learning there; wait for it, or name "
                     "another folder by --output"};
  }
  // Banks are replaced only where the journal is of this very work.
  if (const auto mine = Journal::open(journal.file, journal.title); !mine.has_value()) {
    return mine.error();
  }
  auto begun = begin_curricula({.saca = lessons.thinking->lend(lessons.planes->setup).setup,
                                .intent = &lessons.planes->inputs.intent,
                                .made_with = lessons.made_with,
                                .seed = request.from.seed,
                                .exact = request.from.exact,
                                .lies = request.lies,
                                .judging = {}},
                               lessons.start, request.folder, request.seeds);
  if (!begun.has_value()) {
    return begun.error();
  }
  School school(std::move(begun).value(), lessons.encounters.at, lessons.count,
                request.from.threads);
  return taught_by(school, journal);
}

}  // namespace saca::curricula
