// What every record has in common: gaps read as empty, angles, policies in words.

const radians = (degrees) => (degrees * Math.PI) / 180;
const list = (value) => (Array.isArray(value) ? value : []);
const dict = (value) => (value && typeof value === "object" && !Array.isArray(value) ? value : {});

const policy_words = [
  "full braking in the lane", "lane change left at constant speed", "lane change right at constant speed",
  "lane change left while braking", "lane change right while braking", "drift to a stop, turned left",
  "drift to a stop, turned right", "no intervention"];

/** A plan of a record by its number, its policy's short name and the speed that it brakes to. */
const plan_name = (plan) => `${plan.policy} ${plan.name ?? ""}${is_number(plan.target_speed_mps) ? ` to ${num(plan.target_speed_mps, 1, "m/s")}` : ""}`;

/** A policy in words; `target_speed` [m/s] or null. */
function plan_words(policy, name, target_speed) {
  const words = policy_words[policy] ?? "";
  return is_number(target_speed) ? `${words} to ${num(target_speed, 1, "m/s")}` : words;
}
