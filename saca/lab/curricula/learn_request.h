#pragma once

#include <string>

#include "saca/lab/suites/suite_request.h"

namespace saca::curricula {

/// Which encounters memories go through, and with what (`saca learn`).
struct LearnRequest {
  suites::SuiteRequest from;  ///< which encounters; `count` of each seed
  int seeds = 5;
  double lies = 0.05;  ///< share of what one memory is told that is the opposite of the truth
  bool empty_memory = false;  ///< all begin with no case
  std::string folder;         ///< for banks and journal; empty: usual_folder
};

/// As figures name them: the suite's name, or that of the folder of scenarios.
[[nodiscard]] std::string suite_of(const LearnRequest& request);

/// "runs/learn-NAME-SPLIT".
[[nodiscard]] std::string usual_folder(const LearnRequest& request);

/// What asks for the same again, without the program's name, for records.
[[nodiscard]] std::string command_text(const LearnRequest& request);

}  // namespace saca::curricula
