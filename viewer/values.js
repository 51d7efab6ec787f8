// What every record has in common: gaps read as empty, angles, policies in words.

const radians = (degrees) => (degrees * Math.PI) / 180;
const list = (value) => (Array.isArray(value) ? value : []);
const dict = (value) => (value && typeof value === "object" && !Array.isArray(value) ? value : {});

const policy_words = [
  "full braking in the lane", "lane change left at constant speed", "lane change right at constant speed",
  "lane change left while braking", "lane change right while braking", "drift to a stop, turned left",
  "drift to a stop, turned right", "no intervention"];

/** What a plan adds to its policy: the speed that it brakes to, or how hard it brakes. */
function plan_parameter({ target_speed_mps, strength }) {
  if (is_number(target_speed_mps)) return ` to ${num(target_speed_mps, 1, "m/s")}`;
  return is_number(strength) && strength < 1 ? ` at ${num(100 * strength, 0)} % of the grip` : "";
}

/** A plan of a record by its number, its policy's short name and what it adds to that. */
const plan_name = (plan) => `${plan.policy} ${plan.name ?? ""}${plan_parameter(plan)}`;

/** A policy in words; `plan` may have `target_speed_mps` or `strength`. */
function plan_words(policy, plan) {
  const parameter = plan_parameter(dict(plan));
  const words = parameter && policy === 0 ? "braking in the lane" : policy_words[policy] ?? "";
  return words + parameter;
}
