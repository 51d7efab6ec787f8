#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saca/lab/report/record_in_words.h"

namespace saca::runs {

/// The document of `saca explain --json`: schema saca.explanation/1.
[[nodiscard]] nlohmann::json explanation_json(const std::vector<report::Paragraph>& paragraphs);

/// For people: what each paragraph is about, below it its sentences.
[[nodiscard]] std::string explanation_text(const std::vector<report::Paragraph>& paragraphs);

}  // namespace saca::runs
