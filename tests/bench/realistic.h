#pragma once

#include <cstddef>
#include <fmt/format.h>
#include <string>

namespace orb::bench {

/// Returns a program as people write them for the ball: a main loop with sensors, colours and
/// driving, and subroutines. About `bytes` long; the linter finds nothing in it.
inline std::string basic_program(std::size_t bytes) {
  std::string out = "10 basflg 1\n20 C = 0\n30 R = 0\n40 H = 0\n50 B = 0\n";
  std::string tail;
  int main = 100;
  int sub = 20000;
  while (out.size() + tail.size() < bytes) {
    out += fmt::format("{} for I = 1 to 4\n", main);
    out += fmt::format("{} H = (H + 90) % 360\n", main + 10);
    out += fmt::format("{} goroll H,128,1\n", main + 20);
    out += fmt::format("{} delay 1000 + I * 50\n", main + 30);
    out += fmt::format("{} RGB rnd 255,rnd 255,rnd 255\n", main + 40);
    out += fmt::format("{} next I\n", main + 50);
    out += fmt::format("{} C = dshake\n", main + 60);
    out += fmt::format("{} if C > 0 then LEDC 1 else LEDC 2\n", main + 70);
    out += fmt::format("{} R = sqrt (xpos*xpos + ypos*ypos)\n", main + 80);
    out += fmt::format("{} if R < 20 and speed > 3 then gosub {}\n", main + 90, sub);
    out += fmt::format("{} print \"position\", xpos, ypos\n", main + 100);
    out += fmt::format("{} timerA = 125\n", main + 110);
    out += fmt::format("{} if timerA > 0 then goto {}\n", main + 120, main + 120);
    out += fmt::format("{} B = 255 * ((yaw/45) & 1)\n", main + 130);
    out += fmt::format("{} backLED B\n", main + 140);
    tail += fmt::format("{} print \"near \" R\n", sub);
    tail += fmt::format("{} goroll H,0,0\n", sub + 10);
    tail += fmt::format("{} return\n", sub + 20);
    main += 200;
    sub += 100;
  }
  return out + fmt::format("{} goto 100\n", main) + tail;
}

/// Returns an equivalent Lua chunk of about the same size.
inline std::string lua_chunk(std::size_t bytes) {
  std::string out = "local C, R, H, B = 0, 0, 0, 0\nbasflg(1)\n";
  std::string tail;
  int n = 1;
  while (out.size() + tail.size() < bytes) {
    out += "for I = 1, 4 do\n  H = (H + 90) % 360\n  goroll(H, 128, 1)\n  delay(1000 + I * 50)\n"
           "  RGB(rnd(255), rnd(255), rnd(255))\nend\nC = dshake()\n"
           "if C > 0 then LEDC(1) else LEDC(2) end\nR = sqrt(xpos*xpos + ypos*ypos)\n";
    out += fmt::format("if R < 20 and speed > 3 then near{}(R, H) end\n", n);
    out += "print(\"position\", xpos, ypos)\ntimerA = 125\nwhile timerA > 0 do tick() end\n"
           "B = 255 * band(yaw / 45, 1)\nbackLED(B)\n";
    tail +=
        fmt::format("function near{}(R, H)\n  print(\"near \", R)\n  goroll(H, 0, 0)\nend\n", n);
    ++n;
  }
  return out + tail;
}

} // namespace orb::bench
