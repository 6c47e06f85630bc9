#pragma once

#include "spec/carried.h"
#include "spec/robots.h"

#include <array>
#include <cstdint>
#include <string_view>

/// The JavaScript API of Sphero Edu. Source: WIKI, TYPED, LIB.
namespace orb::spec {

/// Sets of robots used in rows of the API: a bit for each robot.
namespace edu_set {
inline constexpr V2Robots Classic =
    only(Robot::Sphero) | only(Robot::SprkPlus) | only(Robot::Bb8) | only(Robot::Ollie);
inline constexpr V2Robots Bolt = only(Robot::Bolt);
inline constexpr V2Robots BoltPlus = only(Robot::BoltPlus);
inline constexpr V2Robots Rvr = only(Robot::Rvr);
inline constexpr V2Robots Bb9e = only(Robot::Bb9e);
inline constexpr V2Robots R2 = v2_set::R2;
inline constexpr V2Robots Balls = Classic | only(Robot::Mini) | Bolt | BoltPlus | Bb9e;
inline constexpr V2Robots NotRvr = Balls | R2;
inline constexpr V2Robots All = NotRvr | Rvr;
inline constexpr V2Robots Matrix = v2_set::Matrix;
inline constexpr V2Robots Infrared = v2_set::Infrared;
inline constexpr V2Robots Light = Bolt | BoltPlus | Rvr;
inline constexpr V2Robots Compass = Bolt | BoltPlus | Rvr;
inline constexpr V2Robots FrontLight = Bolt | BoltPlus | Rvr | R2;
/// Robots whose back light has colours.
inline constexpr V2Robots BackColor = FrontLight;
} // namespace edu_set

enum class EduCall : std::uint8_t {
#define EDU_CALL(enumerator, ...) enumerator,
#include "spec/edu.def"
};

enum class EduGroup : std::uint8_t { Movement, Lights, Matrix, Sounds, Sensors, Infrared, Program };
enum class EduKind : std::uint8_t { Awaited, AtOnce, Reads, Flow };
enum class EduGives : std::uint8_t {
  Nothing,
  Number,
  Bool,
  Text,
  Color,
  Point,
  Vector,
  Angles,
  Motors
};
enum class EduType : std::uint8_t {
  Number,
  Whole,
  Bool,
  Text,
  Color,
  ColorOrNumber,
  Point,
  Event,
  Function,
  Condition,
  List,
  Picture,
  Any
};
enum class EduPresence : std::uint8_t { Required, Optional, Rest };
enum class EduCondition : std::uint8_t { Nothing, Number, Test };

/// The names of the sets, for lists.
constexpr auto edu_groups = std::to_array<std::string_view>(
    {"movement", "lights", "matrix", "sounds", "sensors", "infrared", "program"});
constexpr auto edu_kinds = std::to_array<std::string_view>({"awaited", "at once", "reads", "flow"});
constexpr auto edu_gives = std::to_array<std::string_view>(
    {"nothing", "number", "bool", "text", "color", "point", "vector", "angles", "motors"});
constexpr auto edu_types = std::to_array<std::string_view>(
    {"number", "whole", "bool", "text", "color", "color or number", "point", "event", "function",
     "condition", "list", "picture", "any"});
constexpr auto edu_presences = std::to_array<std::string_view>({"required", "optional", "rest"});
constexpr auto edu_conditions = std::to_array<std::string_view>({"nothing", "number", "test"});

struct EduCallInfo {
  EduCall call;
  std::string_view name;
  EduGroup group;
  EduKind kind;
  EduGives gives;
  V2Robots robots;
  std::string_view source;
  std::string_view example;
  std::string_view summary;
};

inline constexpr auto edu_calls = [] {
  using namespace edu_set;
  return std::to_array<EduCallInfo>({
#define EDU_CALL(enumerator, name, group, kind, gives, robots, source, example, summary)           \
  carried<EduCallInfo>({EduCall::enumerator, name, EduGroup::group, EduKind::kind,                 \
                        EduGives::gives, robots, source, example, summary}),
#include "spec/edu.def"
  });
}();

constexpr const EduCallInfo& info(EduCall call) {
  return edu_calls[static_cast<std::size_t>(call)];
}
/// Finds the row of a name; null if the API does not have it.
constexpr const EduCallInfo* find_edu_call(std::string_view name) {
  for (const auto& row : edu_calls)
    if (row.name == name)
      return &row;
  return nullptr;
}

struct EduOperand {
  EduCall call;
  std::string_view name;
  EduType type;
  int least; ///< of a text: its length; of a colour or a point: its parts
  int most;
  EduPresence presence;
  std::string_view unit;
};

inline constexpr auto edu_operands = std::to_array<EduOperand>({
#define EDU_OPERAND(call, name, type, least, most, presence, unit)                                 \
  {EduCall::call, name, EduType::type, least, most, EduPresence::presence, unit},
#include "spec/edu.def"
});

/// Returns the operand of a call at `place`, from 0, which must exist.
constexpr const EduOperand& edu_operand(EduCall call, std::size_t place) {
  const auto* row = edu_operands.data();
  while (row->call != call)
    ++row;
  return row[place]; // the operands of a call are adjacent
}

struct EduEventInfo {
  std::string_view name;
  EduGives says;
  EduCondition condition;
  V2Robots robots;
  std::string_view source;
  std::string_view summary;
};

inline constexpr auto edu_events = [] {
  using namespace edu_set;
  return std::to_array<EduEventInfo>({
#define EDU_EVENT(enumerator, name, says, condition, robots, source, summary)                      \
  {name, EduGives::says, EduCondition::condition, robots, source, summary},
#include "spec/edu.def"
  });
}();

/// The lamps that a call sets on a robot.
struct EduLamp {
  EduCall call;
  V2Robots robots;
  std::uint32_t mask;
  std::string_view source;
};

inline constexpr auto edu_lamps = [] {
  using namespace edu_set;
  return std::to_array<EduLamp>({
#define EDU_LAMP(call, robots, mask, source) {EduCall::call, robots, mask, source},
#include "spec/edu.def"
  });
}();

/// Returns their mask; 0 if the robot has none of them.
constexpr std::uint32_t edu_lamps_of(EduCall call, Robot robot) {
  for (const auto& row : edu_lamps)
    if (row.call == call && (row.robots & only(robot)) != 0)
      return row.mask;
  return 0;
}

struct EduObject {
  std::string_view name;
  std::string_view members; ///< separated by spaces; empty if nobody has listed them all
  std::string_view source;
};

inline constexpr auto edu_objects = std::to_array<EduObject>({
#define EDU_OBJECT(name, members, source) {name, members, source},
#include "spec/edu.def"
});

struct EduOldName {
  std::string_view name;
  std::string_view now;
};

inline constexpr auto edu_old_names = std::to_array<EduOldName>({
#define EDU_OLD(name, now) {name, now},
#include "spec/edu.def"
});

} // namespace orb::spec
