#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "saca/onboard/collision/harm.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/memory/experience.h"
#include "saca/thinking/preview/forecast_facts.h"
#include "saca/thinking/preview/situation.h"

namespace saca::language_model {

/// Of a scene part, by `tokens_at_most`, however crowded the scene is: most have some 270.
constexpr int most_prompt_tokens = 360;

/// The policies whose forecast cannot be told from the best one: they can be driven, and their harm
/// is at most forecast::admissible_harm, braking being as its facts have it. None where nothing can
/// be driven.
[[nodiscard]] memory::Policies admissible(const preview::AllFacts& facts);

/// Does a policy lead to a side where oncoming traffic is?
[[nodiscard]] bool leads_into_oncoming(const world::Road& road, manoeuvre::PolicyId policy);

/// The part of the prompt that never changes: the policies, the rule by which they are chosen
/// (from `collision::better`, with the order of `collision::severity` and the weights of
/// data/harm.toml), and the form of the reply.
[[nodiscard]] std::string system_part(const collision::HarmModel& harm);

/// One forecast as the model reads it: what stands in the sections of the paper's Fig. 8 and 10, in
/// their order and without their headings, which take time to be read, and what was computed about
/// each manoeuvre; docs/formats.md gives every line. The model weighs these facts; it does not
/// compute.
///
/// Every word is from a fixed list and every name ours ("car1"): nothing that came from outside
/// stands in it as text. Positions are of centres, seen from the ego's centre of mass, ahead and
/// left in words; of metres and metres per second those below ten have one decimal, others none.
///
/// What does not fit into some 300 tokens is left out, the lightest first: what the case teaches,
/// lines of road users of low risk, who are counted instead, and of policies that are forecast
/// badly, how they come to their harm. Who is hit if nothing is done, else the most dangerous road
/// user, is told always.
///
/// @param nearest     the stored case that is most alike, if there is one
/// @param similarity  of that case, in [0, 1]
/// @throws ContractViolation  if the situation's lists and the scene's actors differ in number
[[nodiscard]] std::string scene_part(const preview::Situation& situation,
                                     const std::optional<memory::Case>& nearest, double similarity);

/// A scene part without what was computed about each manoeuvre, as the paper's prompts are: to find
/// out what that is worth. Where not everybody is told of, who is stays as it was.
[[nodiscard]] std::string without_facts(const std::string& scene_part);
/// Likewise without how dangerous each road user is; who comes first stays so.
[[nodiscard]] std::string without_risks(const std::string& scene_part);

/// What a policy's line of a scene part begins with: "3 ES-B-L", "0 AEB at 45 % of the grip".
[[nodiscard]] std::string policy_label(const manoeuvre::Plan& plan);

/// Told as no harm in a scene part: below this [harm].
constexpr double prompt_no_harm = 0.5e-3;
/// As a scene part tells it, rounded to 0.001, from 0.1 on to 0.01, from 1 on to 0.1: "harm 0.013",
/// "harm 1.2", or "no harm".
[[nodiscard]] std::string prompt_harm(double harm);

/// A policy's line of a scene part, told in whole: "1 AES-L: hits truck1 at 9.0 m/s, harm 0.013".
/// @param facts  of one that can be driven
[[nodiscard]] std::string prompt_policy(const preview::PolicyFacts& facts,
                                        const world::Scene& scene);

/// How far it is to an edge of the road, as a scene part tells it: "5.2".
/// @param way  [m]; below 0: the ego is beyond it
[[nodiscard]] std::string edge_distance(double way);

/// What a policy is forecast to end in, in one line, for people and for reviews: "0 AEB: clear by
/// 0.6 m, no harm".
[[nodiscard]] std::string policy_line(const preview::PolicyFacts& facts, const world::Scene& scene);

/// "harm 0.0125", or "no harm" where that would be four zeros.
[[nodiscard]] std::string harm_text(double harm);

/// What a cue is called in a prompt: "row of parked vans".
[[nodiscard]] std::string_view cue_text(world::CueKind kind);
/// And where it is said to be: "12 m ahead, 3.5 m right".
[[nodiscard]] std::string cue_place(const world::Cue& cue, const world::Scene& scene);

/// What stands beyond an edge: "open ground", "kerb", "barrier" or "trees".
[[nodiscard]] std::string_view beyond_text(world::Beyond beyond);

/// Whether a line of a scene part is that policy's, the ego's own, or that of the most alike case.
[[nodiscard]] bool is_line_of(std::string_view line, manoeuvre::PolicyId policy);
[[nodiscard]] bool is_line_of_ego(std::string_view line);
[[nodiscard]] bool is_line_of_case(std::string_view line);

}  // namespace saca::language_model
