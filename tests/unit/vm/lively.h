#pragma once

#include <string_view>

namespace orb::vm {

/// A program that drives, blinks, reads every sensor, draws random numbers and bumps into walls.
inline constexpr std::string_view lively =
    "10 basflg 1\n"
    "20 H = rnd 360 - 1\n"
    "30 goroll H,40 + rnd 200,1\n"
    "40 for T = 1 to 20\n"
    "50 RGB speed,yaw/2,T*12\n"
    "60 print xpos,ypos,yaw;\n"
    "70 A = A + accelX + accelY * 3 + gyroZ - Qzero + Vbatt\n"
    "80 if accelone > 2000 then print \"bump\", accelone\n"
    "90 delay 20 + rnd 30\n"
    "100 next T\n"
    "110 if A % 3 = 0 then heading A & 127 else raw 1,rnd 255,2,rnd 255\n"
    "120 delay 100\n"
    "130 ctrl = 1\n"
    "140 goto 20\n";

} // namespace orb::vm
