#pragma once

#include <string>
#include <string_view>

#include "saca/base/world/scene.h"
#include "saca/onboard/manoeuvre/plan.h"

namespace saca::report {

// Colours from Okabe and Ito's set for colour-blind readers, some darkened; never the only sign.
// Policies: one hue for each kind of manoeuvre; stripes, or dashes, mean to the right. Intentions:
// blues to the left, browns to the right, the dark ones while braking.

/// Class of an area in a policy's colour: "p0" to "p7".
[[nodiscard]] inline std::string policy_area(manoeuvre::PolicyId policy) {
  return "p" + std::to_string(manoeuvre::index(policy));
}

/// Class of a line in a policy's colour: "l0" to "l7".
[[nodiscard]] inline std::string policy_stroke(manoeuvre::PolicyId policy) {
  return "l" + std::to_string(manoeuvre::index(policy));
}

/// Class of an actor's body: its kind in words.
[[nodiscard]] inline std::string_view body_class(world::ActorKind kind) {
  return world::name(kind);
}

inline constexpr std::string_view svg_style = R"svg(
.saca text{font-family:system-ui,-apple-system,"Segoe UI","Liberation Sans",Arial,sans-serif;fill:#17202a;font-size:11px}
.saca .card{fill:#fff;stroke:#d3dae1}
.saca .frame{fill:none;stroke:#d3dae1}
.saca .heading{font-size:18px;font-weight:600}
.saca .title{font-size:13px;font-weight:600}
.saca .soft{fill:#525d6a}
.saca .strong{font-weight:600}
.saca .badge{fill:#00674f}
.saca .badge-text{fill:#fff;font-weight:600}
.saca .halo{paint-order:stroke;stroke:#fff;stroke-width:3px;stroke-linejoin:round}
.saca .ground{fill:#e7ebe2}
.saca .paved{fill:#dde2e7}
.saca .road{fill:#c3cad2}
.saca .mark{fill:none;stroke:#fff;stroke-width:1.6px}
.saca .dashed{stroke-dasharray:9 9}
.saca .edge{fill:none;stroke:#8b949e;stroke-width:1px}
.saca .kerb{fill:#eef0f2;stroke:#69737d;stroke-width:.6px}
.saca .kerb-hatch{fill:url(#saca-kerb)}
.saca .barrier{fill:none;stroke:#4b545d;stroke-width:3px}
.saca .post{fill:#4b545d}
.saca .tree{fill:#8fb388;stroke:#5d8557;stroke-width:.6px}
.saca .trunk{fill:#5b4a3a}
.saca .ghost{stroke-width:1px}
.saca .body{stroke-width:1.2px}
.saca .trail{fill:none;stroke-width:1.4px;stroke-opacity:.55}
.saca .touch{fill:none;stroke-width:1.6px;stroke-dasharray:3 2}
.saca .fan{fill:none;stroke:#b8458f;stroke-linejoin:round}
.saca .fan-place{fill:#b8458f;fill-opacity:.25;stroke:#b8458f;stroke-width:.8px}
.saca .glass{fill:#10202c;fill-opacity:.75}
.saca .ego{fill:#0072b2;stroke:#003f63}
.saca .car{fill:#e08a00;stroke:#7a4a00}
.saca .van{fill:#c77700;stroke:#6b4000}
.saca .truck{fill:#b5530a;stroke:#5f2a00}
.saca .motorcycle{fill:#7b4fb5;stroke:#432470}
.saca .bicycle{fill:#009e73;stroke:#00533c}
.saca .pedestrian{fill:#d1407f;stroke:#7c1546}
.saca .obstacle{fill:#5f6974;stroke:#2b3138}
.saca .ego.trail,.saca .car.trail,.saca .van.trail,.saca .truck.trail,.saca .motorcycle.trail,.saca .bicycle.trail,.saca .pedestrian.trail,.saca .obstacle.trail{fill:none}
.saca .ego.touch,.saca .car.touch,.saca .van.touch,.saca .truck.touch,.saca .motorcycle.touch,.saca .bicycle.touch,.saca .pedestrian.touch,.saca .obstacle.touch{fill:none}
.saca .star{fill:#c00036;stroke:#fff;stroke-width:1.2px}
.saca .later{fill:#fff;stroke:#c00036;stroke-width:1.6px}
.saca .scale{fill:none;stroke:#17202a;stroke-width:1.4px}
.saca .person{fill:none;stroke:#d1407f;stroke-width:1.2px}
.saca .faded{opacity:.5}
.saca .axis{fill:none;stroke:#525d6a;stroke-width:1px}
.saca .grid{stroke:#e3e7ec;stroke-width:1px}
.saca .nominal{fill:none;stroke:#000;stroke-width:1.6px}
.saca .nominal-halo{fill:none;stroke:#fff;stroke-width:4px}
.saca .p0{fill:#0072b2}.saca .p1,.saca .p2{fill:#e69f00}.saca .p3,.saca .p4{fill:#009e73}.saca .p5,.saca .p6{fill:#b8458f}.saca .p7{fill:#77808a}
.saca .m1{fill-opacity:.22}.saca .m2{fill-opacity:.45}.saca .m3{fill-opacity:.7}
.saca .right{fill:url(#saca-right)}
.saca .no-risk{fill:url(#saca-dots)}
.saca .unplayable{fill:url(#saca-cross)}
.saca .l0{stroke:#0072b2}.saca .l1,.saca .l2{stroke:#c98600}.saca .l3,.saca .l4{stroke:#00805d}.saca .l5,.saca .l6{stroke:#b8458f}.saca .l7{stroke:#5f6974}
.saca .l2,.saca .l4,.saca .l6{stroke-dasharray:5 3}
.saca .curve{fill:none;stroke-width:2px;stroke-linejoin:round}
.saca .band{fill-opacity:.14}
.saca .dash{stroke-dasharray:6 4}
.saca .stroke-blue{stroke:#0072b2}.saca .stroke-orange{stroke:#c98600}.saca .stroke-green{stroke:#00805d}.saca .stroke-purple{stroke:#b8458f}.saca .stroke-grey{stroke:#77808a}.saca .stroke-ink{stroke:#17202a}
.saca .fill-blue{fill:#0072b2}.saca .fill-orange{fill:#e69f00}.saca .fill-green{fill:#009e73}.saca .fill-purple{fill:#b8458f}.saca .fill-grey{fill:#77808a}.saca .fill-ink{fill:#17202a}
.saca .dot{stroke:#fff;stroke-width:1px}
.saca .i0{fill:#d7dde4}.saca .i1{fill:#56b4e9}.saca .i2{fill:#f0b32e}.saca .i3{fill:#b8458f}.saca .i4{fill:#00508a}.saca .i5{fill:#9a4a00}
.saca .mark-line{stroke:#c00036;stroke-width:1px;stroke-dasharray:2 3}
.saca .on-dark{fill:#fff}
)svg";

inline constexpr std::string_view svg_patterns =
    R"svg(<pattern id="saca-kerb" width="4" height="4" patternUnits="userSpaceOnUse" patternTransform="rotate(45)"><rect width="1.4" height="4" fill="#69737d"/></pattern>
<pattern id="saca-right" width="6" height="6" patternUnits="userSpaceOnUse" patternTransform="rotate(45)"><rect width="2" height="6" fill="#10181f" fill-opacity=".34"/></pattern>
<pattern id="saca-dots" width="6" height="6" patternUnits="userSpaceOnUse"><circle cx="2" cy="2" r=".9" fill="#9aa4af"/></pattern>
<pattern id="saca-cross" width="7" height="7" patternUnits="userSpaceOnUse" patternTransform="rotate(45)"><path d="M0 0H7M0 0V7" stroke="#525d6a" stroke-width="1.6"/></pattern>
)svg";

}  // namespace saca::report
