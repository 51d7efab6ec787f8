#include "saca/lab/cases/case_set.h"

#include <utility>

#include "saca/lab/long_work/output_file.h"
#include "saca/thinking/memory/case_json.h"

namespace saca::cases {

CaseSet case_set(std::vector<CaseRow> rows) {
  CaseSet all;
  all.cases.reserve(rows.size());
  for (CaseRow& row : rows) {
    if (!row.problem.empty()) {
      all.problems.push_back(std::move(row.problem));
    }
    if (row.made) {
      row.made->judged.one.id = static_cast<match::CaseId>(all.cases.size() + 1);
      all.cases.push_back(*std::move(row.made));
    }
  }
  return all;
}

std::vector<memory::Case> memory_cases(const std::vector<CrashCase>& cases) {
  std::vector<memory::Case> plain;
  plain.reserve(cases.size());
  for (const CrashCase& one : cases) {
    plain.push_back(one.judged.one);
  }
  return plain;
}

std::vector<memory::Case> driver_cases(const std::vector<CrashCase>& cases) {
  std::vector<memory::Case> driven;
  for (const CrashCase& one : cases) {
    if (const auto& driver = one.judged.driver) {
      driven.push_back(one.judged.one);
      driven.back().best = *driver;
      driven.back().best_harm =
          one.judged.one.happened.value_or(memory::PolicyHarms{})[manoeuvre::index(*driver)]
              .value_or(one.judged.one.best_harm);
    }
  }
  return driven;
}

std::optional<Error> write_cases(const CaseOutputs& outputs, const std::vector<CrashCase>& cases) {
  if (auto problem = long_work::write_output(outputs.cases, crash_cases_text(cases))) {
    return problem;
  }
  if (!outputs.memory.empty()) {
    if (auto problem =
            long_work::write_output(outputs.memory, memory::cases_text(memory_cases(cases)))) {
      return problem;
    }
  }
  return outputs.drivers.empty()
             ? std::nullopt
             : long_work::write_output(outputs.drivers, memory::cases_text(driver_cases(cases)));
}

}  // namespace saca::cases
