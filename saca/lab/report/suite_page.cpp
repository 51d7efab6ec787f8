#include "saca/lab/report/suite_page.h"

#include <fmt/format.h>

#include <string_view>

#include "saca/base/core/contract.h"
#include "saca/lab/report/palette.h"
#include "saca/lab/report/svg.h"

namespace saca::report {
namespace {

constexpr SvgSize card_picture{420.0, 270.0};

constexpr std::string_view suite_style = R"(
:root { color-scheme: light; }
body { margin: 1.5rem auto; max-width: 1240px; padding: 0 1rem; background: #fff; color: #17202a;
  font: 15px/1.45 system-ui, "Liberation Sans", sans-serif; }
p { max-width: 90ch; margin: .4rem 0; }
p.first { font-size: 17px; }
h2 { margin: 2rem 0 .3rem; font-size: 1.2rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; margin: .6rem 0; font-size: 13.5px; font-variant-numeric: tabular-nums; }
th, td { border-bottom: 1px solid #e3e7ec; padding: .28rem .6rem; text-align: right; white-space: nowrap; }
th:first-child, td:first-child { text-align: left; position: sticky; left: 0; background: #fff; }
thead th { border-bottom: 2px solid #8b949e; vertical-align: bottom; white-space: normal; max-width: 9rem; }
tr.faded td { color: #525d6a; font-style: italic; }
.cards { display: grid; grid-template-columns: repeat(auto-fill, minmax(890px, 1fr)); gap: 1rem; }
.card { border: 1px solid #d3dae1; border-radius: 4px; padding: .6rem; }
.card h3 { margin: 0; font-size: 1rem; }
.card details { margin: .3rem 0; font-size: 13.5px; }
.card details td, .card details th { text-align: left; white-space: normal; }
.card .pair { display: flex; flex-wrap: wrap; gap: .5rem; }
code { background: #f2f4f6; padding: .1rem .3rem; border-radius: 3px; font-size: 12.5px; overflow-wrap: anywhere; }
.notes { color: #525d6a; font-size: 13px; }
)";

std::string paragraphs(const std::vector<std::string>& lines, std::string_view of_class = "") {
  std::string html;
  for (const std::string& line : lines) {
    html += of_class.empty() ? fmt::format("<p>{}</p>\n", escaped(line))
                             : fmt::format("<p class=\"{}\">{}</p>\n", of_class, escaped(line));
  }
  return html;
}

/// White where nothing is lost, the deeper the worse; black text stays readable on all of it.
std::string shade(const std::optional<double>& value) {
  if (!value) {
    return "";
  }
  expects(*value >= 0.0 && *value <= 1.0, "shades lie in [0, 1]");
  return fmt::format(" style=\"background:rgba(213,94,0,{:.2f})\"", 0.75 * *value);
}

/// Without its heading.
std::string bare_table(const PageTable& table) {
  std::string html = paragraphs(table.lines);
  if (table.chart) {
    html += dots_svg(*table.chart);
  }
  html += "<div class=\"wide\"><table><thead><tr><th></th>";
  for (const std::string& column : table.columns) {
    html += fmt::format("<th>{}</th>", escaped(column));
  }
  html += "</tr></thead><tbody>\n";
  for (const PageTable::Row& row : table.rows) {
    expects(row.cells.size() == table.columns.size(), "one cell per column");
    expects(row.shades.empty() || row.shades.size() == row.cells.size(), "one shade per cell");
    html += fmt::format(
        "<tr{}><td{}>{}</td>", row.faded ? " class=\"faded\"" : "",
        row.explanation.empty() ? "" : fmt::format(" title=\"{}\"", escaped(row.explanation)),
        row.link.empty()
            ? escaped(row.name)
            : fmt::format("<a href=\"{}\">{}</a>", escaped(row.link), escaped(row.name)));
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      html += fmt::format("<td{}>{}</td>", row.shades.empty() ? "" : shade(row.shades[i]),
                          escaped(row.cells[i]));
    }
    html += "</tr>\n";
  }
  html += "</tbody></table></div>\n";
  std::string notes;
  for (const PageTable::Row& row : table.rows) {
    if (!row.explanation.empty()) {
      notes += fmt::format("<li><b>{}</b>: {}</li>\n", escaped(row.name), escaped(row.explanation));
    }
  }
  return notes.empty()
             ? html
             : html + "<details><summary>What each row is</summary><ul class=\"notes\">\n" + notes +
                   "</ul></details>\n";
}

std::string table_html(const PageTable& table) {
  return fmt::format("<h2>{}</h2>\n{}", escaped(table.heading), bare_table(table));
}

std::string picture(const SceneView& view) {
  return svg_in_page(card_picture, view.title, scene_card(view, card_picture));
}

std::string card_html(const GalleryCard& card) {
  std::string html = fmt::format(
      "<section class=\"card\"><h3>{}</h3>\n{}<div class=\"pair\">{}{}</div>\n",
      escaped(card.title), paragraphs(card.lines), picture(card.done), picture(card.best));
  if (!card.command.empty()) {
    html += fmt::format("<p><code>{}</code></p>", escaped(card.command));
  }
  for (const PageTable& table : card.tables) {
    html += bare_table(table);
  }
  for (const PageTable& table : card.folded) {
    html += fmt::format("<details><summary>{}</summary>\n{}</details>\n", escaped(table.heading),
                        bare_table(table));
  }
  return html + "</section>\n";
}

}  // namespace

std::string suite_page(const SuitePage& page) {
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>"
      "<style>{1}{2}</style></head>\n<body>\n<h1>{0}</h1>\n",
      escaped(page.title), suite_style, svg_style);
  html += fmt::format(
      "<svg width=\"0\" height=\"0\" style=\"position:absolute\"><defs>{}</defs></svg>\n",
      svg_patterns);
  html += paragraphs(page.lines, "first");
  if (page.chart) {
    html += dots_svg(*page.chart);
  }
  for (const PageTable& table : page.tables) {
    html += table_html(table);
  }
  if (!page.gallery.empty()) {
    html += fmt::format("<h2>{}</h2>\n<div class=\"cards\">\n", escaped(page.gallery_heading));
    for (const GalleryCard& card : page.gallery) {
      html += card_html(card);
    }
    html += "</div>\n";
  }
  return html + "<h2>How it was made</h2>\n" + paragraphs(page.footnotes, "notes") +
         "</body></html>\n";
}

}  // namespace saca::report
