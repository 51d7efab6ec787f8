#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/report/authors_page.h"
#include "saca/lab/verification/authors_comparison.h"
#include "saca/lab/verification/authors_network.h"
#include "saca/thinking/danger/value_file.h"

/// A solved value beside the network that the paper's authors published, for `saca reach compare`.
namespace saca::reach_study {

/// The network knows of one obstacle and of no motion of it.
/// @param file  of the solution, for messages
/// @return      why the solution cannot stand beside it: Error::Code::malformed or out_of_range
[[nodiscard]] std::optional<Error> why_not_comparable(const danger::Solution& solved,
                                                      const std::string& file);

/// Pairs of maps: at these speeds [m/s] and this course [deg], of which either may be left out;
/// without both some of each.
[[nodiscard]] std::vector<report::AuthorsView> authors_views(const std::vector<double>& speeds,
                                                             std::optional<double> course);

/// What of a comparison is to be drawn.
struct AuthorsRequest {
  enum class Format { page, picture };  ///< HTML with figures, or the maps alone as PNG
  std::string file;                     ///< of the solution: its name where the case has none
  std::string network_name;
  std::vector<report::AuthorsView> views;
  Format format = Format::page;
};

struct AuthorsReport {
  verification::AuthorsComparison found;
  std::string drawn;  ///< bytes of the page or picture
};

/// @param solved  comparable
/// @return        an error when there is no memory for a picture
[[nodiscard]] Result<AuthorsReport> authors_report(const danger::Solution& solved,
                                                   const verification::AuthorsNetwork& network,
                                                   const AuthorsRequest& request);

/// reach.authors_net.: counts and shares of all states, and shares at each speed.
[[nodiscard]] nlohmann::json json_of(const verification::AuthorsComparison& found);

/// A table: a line for each speed, and one for all.
[[nodiscard]] std::string text_of(const verification::AuthorsComparison& found);

}  // namespace saca::reach_study
