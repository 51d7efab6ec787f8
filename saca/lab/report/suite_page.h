#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saca/lab/report/chart_svg.h"
#include "saca/lab/report/scene_svg.h"

namespace saca::report {

/// A table of a page: words and figures as they are to be read.
struct PageTable {
  struct Row {
    std::string name;
    std::string
        explanation;   ///< shown when the name is pointed at, and below the table; may be empty
    std::string link;  ///< of the name: a page beside this one; may be empty
    std::vector<std::string> cells;             ///< one per column
    std::vector<std::optional<double>> shades;  ///< of the cells, 0 (none) to 1 (worst); or empty
    bool faded = false;                         ///< a yardstick that no method on a road can be
  };
  std::string heading;
  std::vector<std::string> lines;    ///< below the heading
  std::vector<std::string> columns;  ///< without that of the names
  std::vector<Row> rows;
  std::optional<DotChart> chart;  ///< below the heading's lines
};

/// One encounter, what was done in it, and what would have been best.
struct GalleryCard {
  std::string title;
  std::vector<std::string> lines;  ///< what there is to say of it, e.g. why it went wrong
  SceneView done;
  SceneView best;
  std::string command;            ///< that plays it again; may be empty
  std::vector<PageTable> tables;  ///< below the pictures
  std::vector<PageTable> folded;  ///< likewise, each behind its heading
};

/// Methods compared over many encounters.
struct SuitePage {
  std::string title;
  std::vector<std::string> lines;  ///< what there is to see, in sentences; first of all
  std::optional<DotChart> chart;
  std::vector<PageTable> tables;
  std::string gallery_heading;
  std::vector<GalleryCard> gallery;
  std::vector<std::string> footnotes;  ///< how it was made: command, seed, processor
};

/// @return  HTML that needs no other file; the same page makes the same bytes
/// @throws ContractViolation  if a row has another number of cells than its table has columns, a
///                            shade lies outside [0, 1], or as `scene_svg` and `dots_svg`
[[nodiscard]] std::string suite_page(const SuitePage& page);

}  // namespace saca::report
