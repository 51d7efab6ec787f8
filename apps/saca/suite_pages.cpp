#include "apps/saca/suite_pages.h"

#include <filesystem>

#include "saca/lab/eval/suite_file.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/policy_study/policy_sheet.h"
#include "saca/lab/suites/suite_page.h"

namespace saca::app {

std::optional<Error> write_rows_and_page(const SuiteRun& run, const SuiteResult& result,
                                         const suites::SuiteRequest& options) {
  if (auto problem = eval::write_suite(options.output, run.rows, run.methods, run.meta.dump())) {
    return problem;
  }
  return long_work::write_output(
      std::filesystem::path(options.output).replace_extension(".html"),
      report::suite_page(suites::page_of(run, result, options, policy_study::view_of)));
}

}  // namespace saca::app
