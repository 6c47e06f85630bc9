#include "playground/engine/edu_hands.h"

#include "protocol/payload_v2.h"
#include "run/tether/wire_v2.h"
#include "vm/body/angles.h"
#include "vm/matrix.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string_view>
#include <utility>

namespace orb::playground {
namespace {

using spec::EduCall;
using spec::V2Command;

constexpr int greatest = 255;
/// More are pending only if a program draws faster than any robot: the oldest are dropped.
constexpr std::size_t most_waiting = 1024;

/// Returns a number clamped to its bounds; the least if it is not a number.
int number(const ordered_json& value, int least, int most) {
  if (!value.is_number())
    return value.is_boolean() && value.get<bool>() ? std::min(1, most) : least;
  const auto is = value.get<double>();
  return std::isfinite(is) ? static_cast<int>(std::lround(std::clamp<double>(is, least, most)))
                           : least;
}

/// Returns an element of a list; null if there is none. The list must outlive it.
const ordered_json& at(const ordered_json& list, std::size_t i) {
  static const ordered_json none;
  return list.is_array() && i < list.size() ? list[i] : none;
}

const ordered_json& member(const ordered_json& object, const char* name) {
  static const ordered_json none;
  const auto found = object.is_object() ? object.find(name) : object.end();
  return object.is_object() && found != object.end() ? *found : none;
}

std::uint8_t byte(const ordered_json& value) {
  return static_cast<std::uint8_t>(number(value, 0, greatest));
}

vm::Color color_of(const ordered_json& value) {
  return {byte(member(value, "r")), byte(member(value, "g")), byte(member(value, "b"))};
}

void append(Bytes& out, vm::Color color) {
  out.insert(out.end(), {color.red, color.green, color.blue});
}

/// Truncates a text to what a robot takes, in ASCII.
void append_text(Bytes& out, const ordered_json& value, std::size_t most) {
  const auto text = value.is_string() ? value.get<std::string>() : std::string();
  for (const char c : std::string_view(text).substr(0, most))
    out.push_back(c >= ' ' && c <= '~' ? static_cast<std::uint8_t>(c) : '?');
}

/// Returns an argument of a call, clamped to the bounds of its operand.
int number(const ordered_json& deed, EduCall call, std::size_t place) {
  const auto& operand = spec::edu_operand(call, place);
  return number(at(deed, place + 1), operand.least, operand.most);
}

struct Direct {
  std::string_view name;
  V2Command command;
};

/// Calls that map to one command of the robot with the same numbers.
constexpr auto direct = std::to_array<Direct>({
    {"startIRBroadcast", V2Command::StartBroadcast},
    {"stopIRBroadcast", V2Command::StopBroadcast},
    {"startIRFollow", V2Command::StartFollow},
    {"stopIRFollow", V2Command::StopFollow},
    {"startIREvade", V2Command::StartEvade},
    {"stopIREvade", V2Command::StopEvade},
    {"pauseMatrixAnimation", V2Command::MatrixPause},
    {"resumeMatrixAnimation", V2Command::MatrixResume},
    {"clearMatrix", V2Command::MatrixReset},
    {"calibrateCompass", V2Command::CalibrateNorth},
});

/// Calls that draw: points, then a colour.
constexpr auto drawn = std::to_array<Direct>({
    {"drawMatrixPixel", V2Command::MatrixPixel},
    {"drawMatrixLine", V2Command::MatrixLine},
    {"drawMatrixFill", V2Command::MatrixFill},
});

} // namespace

void EduHands::send(run::Request request, std::string key) {
  if (!key.empty())
    std::erase_if(waiting_, [&](const auto& one) { return one.first == key; });
  if (waiting_.size() >= most_waiting)
    waiting_.pop_front();
  request.need = run::Request::Need::Try;
  waiting_.emplace_back(std::move(key), std::move(request));
}

void EduHands::send(V2Command command, Bytes data, std::string key) {
  const auto& row = spec::info(command);
  if (knows(command) && protocol::refusal(command, data) == spec::V2Error::Success)
    send(run::Request{row.did(), row.cid(), std::move(data)}, std::move(key));
}

void EduHands::push() {
  if (waiting_.empty() || !tether_.has_sent_soon())
    return;
  tether_.send_soon(std::move(waiting_.front().second));
  waiting_.pop_front();
}

void EduHands::drive(const ordered_json& deed) {
  const int speed = number(deed, EduCall::Roll, 1);
  const int back = speed < 0 ? spec::ball::full_circle / 2 : 0;
  const int heading = vm::whole_heading(number(deed, EduCall::Roll, 0) + aim_ + back);
  tether_.obey(vm::Roll{heading, std::abs(speed), vm::Go::Drive});
}

void EduHands::motors(const ordered_json& deed) {
  const auto motor = [&](std::size_t place) {
    const int power = number(deed, EduCall::RawMotor, place);
    return vm::Motor{power > 0   ? vm::MotorMode::Forward
                     : power < 0 ? vm::MotorMode::Reverse
                                 : vm::MotorMode::Off,
                     std::abs(power)};
  };
  tether_.obey(vm::Motors{motor(0), motor(1)});
}

/// On a lamp with colours, brightness sets the blue part.
void EduHands::light(EduCall call, const ordered_json& value) {
  const auto mask = spec::edu_lamps_of(call, robot_.robot);
  if (mask == 0) {
    if (call == EduCall::SetBackLed)
      tether_.show_back(value.is_object() ? color_of(value).blue : byte(value));
    return;
  }
  Bytes values;
  const auto color = value.is_object() ? color_of(value) : vm::Color{0, 0, byte(value)};
  const auto dome_steps = spec::edu_operand(EduCall::SetDomeLeds, 0).most;
  const auto level = call == EduCall::SetDomeLeds
                         ? number(value, 0, dome_steps) * greatest / dome_steps
                         : int{byte(value)};
  const auto count = static_cast<std::size_t>(std::popcount(mask));
  while (values.size() + 3 <= count)
    append(values, color);
  values.resize(count, static_cast<std::uint8_t>(level));
  send(run::lamps_request(robot_, mask, values), std::string(spec::info(call).name));
}

void EduHands::draw(V2Command command, const ordered_json& deed) {
  Bytes data;
  for (std::size_t i = 2; i < deed.size() && i < 4; ++i) // behind the colour
    for (const char* axis : {"x", "y"})
      data.push_back(
          static_cast<std::uint8_t>(number(member(deed[i], axis), 0, vm::Matrix::side - 1)));
  append(data, color_of(at(deed, 1)));
  send(command, std::move(data));
}

/// Stores the frames, each as four bit planes from the lowest row on, then their animation.
void EduHands::animation(const ordered_json& picture) {
  constexpr int side = vm::Matrix::side;
  constexpr int planes = 4;
  constexpr std::size_t most_frames = 64;
  const auto& frames = member(picture, "frames");
  Bytes list;
  std::size_t count = 0;
  for (; frames.is_array() && count < std::min(frames.size(), most_frames); ++count) {
    Bytes data;
    append_u16(data, static_cast<std::uint32_t>(pictures_));
    const auto& frame = frames[count];
    const auto pixel = [&](int x, int y) { // frames begin with the highest row
      const auto& row = at(frame, static_cast<std::size_t>(side - 1 - y));
      return number(at(row, static_cast<std::size_t>(x)), 0, (1 << planes) - 1);
    };
    for (int plane = 0; plane < planes; ++plane)
      for (int y = 0; y < side; ++y) {
        unsigned bits = 0;
        for (int x = 0; x < side; ++x)
          bits = bits << 1U | (static_cast<unsigned>(pixel(x, y)) >> plane & 1U);
        data.push_back(static_cast<std::uint8_t>(bits));
      }
    send(V2Command::MatrixSaveFrame, std::move(data));
    append_u16(list, static_cast<std::uint32_t>(pictures_++));
  }
  const int fastest = spec::edu_operand(EduCall::ScrollMatrixText, 2).most;
  const auto& palette = member(picture, "palette");
  const std::size_t colors = palette.is_array() ? std::min<std::size_t>(palette.size(), 16) : 0;
  Bytes data{static_cast<std::uint8_t>(animations_++ & greatest),
             static_cast<std::uint8_t>(number(member(picture, "fps"), 1, fastest)),
             static_cast<std::uint8_t>(number(member(picture, "fade"), 0, 1)),
             static_cast<std::uint8_t>(colors)};
  for (std::size_t i = 0; i < colors; ++i)
    append(data, color_of(palette[i]));
  append_u16(data, static_cast<std::uint32_t>(count));
  data.insert(data.end(), list.begin(), list.end());
  send(V2Command::MatrixSaveAnimation, std::move(data));
}

void EduHands::perform(const ordered_json& deed) {
  if (!deed.is_array() || deed.empty() || !deed[0].is_string())
    return;
  const auto name = deed[0].get<std::string>();
  if (name == "drive")
    return drive(deed);
  if (name == "rawMotor")
    return motors(deed);
  if (name == "setStabilization")
    return tether_.obey(number(at(deed, 1), 0, 1) != 0 ? vm::Stabilization::On
                                                       : vm::Stabilization::Off);
  if (name == "resetAim")
    return aim_at(facing_, number(at(deed, 1), 0, spec::ball::full_circle));
  if (name == "setMainLed") {
    // If the matrix is the main light, its colour overwrites pending drawings.
    std::erase_if(waiting_, [](const auto& one) { return one.first.empty(); });
    return tether_.show(color_of(at(deed, 1)));
  }
  for (const auto& row : drawn)
    if (row.name == name)
      return draw(row.command, deed);
  for (const auto& row : direct)
    if (row.name == name) {
      Bytes data;
      // The API names the near channel first, a packet the far one.
      for (std::size_t i = deed.size(); i-- > 1;)
        data.push_back(byte(deed[i]));
      return send(row.command, std::move(data));
    }
  if (name == "setMatrixCharacter") {
    Bytes data;
    append(data, color_of(at(deed, 2)));
    append_text(data, at(deed, 1), 1);
    return send(V2Command::MatrixCharacter, std::move(data));
  }
  if (name == "scrollMatrixText") {
    const auto longest = spec::edu_operand(EduCall::ScrollMatrixText, 0).most;
    Bytes data;
    append(data, color_of(at(deed, 2)));
    data.insert(data.end(),
                {static_cast<std::uint8_t>(number(deed, EduCall::ScrollMatrixText, 2)), 0});
    append_text(data, at(deed, 1), static_cast<std::size_t>(longest));
    return send(V2Command::MatrixText, std::move(data));
  }
  if (name == "registerMatrixAnimation")
    return animation(at(deed, 1));
  if (name == "playMatrixAnimation")
    return send(V2Command::MatrixPlayLoop,
                {byte(at(deed, 1)), static_cast<std::uint8_t>(number(at(deed, 2), 0, 1))});
  if (name == "setMatrixRotation") {
    constexpr int quarter = 90;
    return send(V2Command::MatrixRotation,
                {static_cast<std::uint8_t>(number(deed, EduCall::SetMatrixRotation, 0) / quarter)});
  }
  if (name == "sendIRMessage") {
    const auto strength = static_cast<std::uint8_t>(number(deed, EduCall::SendIRMessage, 1));
    return send(V2Command::SendInfrared,
                {byte(at(deed, 1)), strength, strength, strength, strength});
  }
  if (name == "setDomePosition") {
    Bytes data;
    protocol::append_f32(data, number(deed, EduCall::SetDomePosition, 0));
    return send(V2Command::SetHead, std::move(data));
  }
  if (name == "setStance") {
    const auto& stance = at(deed, 1);
    const bool bipod = stance.is_string()
                           ? stance.get<std::string>().find_first_of("Bw") != std::string::npos
                           : number(stance, 0, 1) == 0;
    return send(V2Command::LegAction, {static_cast<std::uint8_t>(bipod ? 2 : 1)});
  }
  if (name == "setWaddle")
    return send(V2Command::LegAction,
                {static_cast<std::uint8_t>(number(at(deed, 1), 0, 1) != 0 ? 3 : 0)});
  if (const auto* row = spec::find_edu_call(name); row != nullptr)
    if (row->group == spec::EduGroup::Lights)
      light(row->call, at(deed, 1));
}

} // namespace orb::playground
