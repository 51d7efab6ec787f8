#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/preview/situation.h"

namespace saca::language_model {

/// The replies about a forecast that are true (GBNF, as AskOptions::grammars wants it): all that
/// `Statements` puts together, in the order in which models are taught to say it, up to the
/// answer that the text asks for itself. So a model chooses whom it names, what it says of him,
/// which remark it makes and what it comes to among what is admissible; it can say nothing else.
///
/// @param scene_part  of this situation and case, or `without_risks` of it
/// @param nearest     as for the scene part
/// @param choice      what the text has to come to; nullopt: to any policy that is admissible
/// @return            empty where nothing is admissible, the choice is not, or the scene part does
///                    not tell what comes of each manoeuvre: then nothing is known to be true
[[nodiscard]] std::string reply_grammar(const preview::Situation& situation,
                                        std::string_view scene_part,
                                        const std::optional<memory::Case>& nearest,
                                        const std::optional<manoeuvre::PolicyId>& choice = {});

}  // namespace saca::language_model
