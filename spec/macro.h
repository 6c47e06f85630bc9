#pragma once

// The macro system of the robot: commands, flags, parameters, identifiers and sizes. Source: the
// macro part of the quick reference and of the low-level API; if they disagree, the byte output of
// the vendor's own libraries decides (spec/SOURCES.md).

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace orb::spec {

enum class MacroCommand : std::uint8_t {
#define MACRO_COMMAND(Name, code, ...) Name = code,
#include "spec/macro.def"
#undef MACRO_COMMAND
};

enum class MacroFlag : std::uint8_t {
#define MACRO_FLAG(Name, bit, ...) Name = bit,
#include "spec/macro.def"
#undef MACRO_FLAG
};

/// The system-wide values set by API command Set Macro Parameter (57h).
enum class MacroParameter : std::uint8_t {
#define MACRO_PARAMETER(Name, index, ...) Name = index,
#include "spec/macro.def"
#undef MACRO_PARAMETER
};

/// The unit of an operand. Ticks10ms is a time in steps of 10 ms.
enum class MacroUnit : std::uint8_t { None, Milliseconds, Ticks10ms, Degrees };

enum class MacroOperandKind : std::uint8_t {
  Number,
  Delay,   ///< the wait after the command; 0 if omitted in source
  MacroId, ///< the number of a macro; in source, its name too
  Text     ///< a 16-bit length, then that many bytes
};

/// A word for a value of an operand in source.
struct MacroWord {
  std::string_view word;
  std::int32_t value = 0;
};

struct MacroOperand {
  std::string_view name;
  MacroOperandKind kind = MacroOperandKind::Number;
  MacroUnit unit = MacroUnit::None;
  std::uint8_t width = 1; ///< bytes; for a text, of its length
  bool is_signed = false;
  std::int32_t minimum = 0;
  std::int32_t maximum = 0;
  const MacroWord* words = nullptr; ///< words for its values
  std::uint8_t word_count = 0;

  constexpr const MacroWord* begin_words() const { return words; }
  constexpr const MacroWord* end_words() const { return words + word_count; }
};

/// The wait of a command before the next one runs.
enum class MacroWait : std::uint8_t {
  None,
  Operand, ///< its last operand
  Sd1,     ///< system delay 1
  Sd2,     ///< system delay 2
  Stopped  ///< until the ball stops, at most its last operand
};

/// The effect that continues while later commands run.
enum class MacroBackground : std::uint8_t { None, Fade, Rotate };

/// Where a command takes effect. A stream ignores `end` and `gosub`.
enum class MacroPlace : std::uint8_t { Anywhere, OnlyInStream, NeverInStream };

inline constexpr std::size_t macro_max_operands = 6;

/// A row of spec/macro.def. Large because it says everything that assembler, executive, checks and
/// reference need to know about a command.
struct MacroCommandInfo {
  MacroCommand command{};
  std::uint8_t code = 0;
  std::string_view mnemonic;
  std::string_view title; ///< its name in the quick reference
  std::array<MacroOperand, macro_max_operands> operand{};
  std::uint8_t operand_count = 0;
  std::uint8_t length = 1;      ///< bytes including the code; for a comment without its text
  bool variable_length = false; ///< a text follows
  bool has_pcd = false;         ///< its last byte is a post command delay
  MacroWait wait = MacroWait::None;
  MacroBackground background = MacroBackground::None;
  MacroPlace place = MacroPlace::Anywhere;
  std::uint8_t executive = 2; ///< the least version of the macro executive
  std::string_view source;
  std::string_view summary;
  std::string_view example;

  constexpr const MacroOperand* begin() const { return operand.data(); }
  constexpr const MacroOperand* end() const { return operand.data() + operand_count; }
};

struct MacroFlagInfo {
  MacroFlag flag{};
  std::uint8_t bit = 0;
  std::string_view word;
  std::string_view name; ///< its documented name
  std::string_view summary;
};

struct MacroParameterInfo {
  MacroParameter parameter{};
  std::uint8_t index = 0;
  std::string_view word;
  std::string_view summary;
};

// Identifiers. Source: low-level API §Macro IDs.
#define MACRO_NUMBER(type, name, value, unit, source, summary) inline constexpr type name = value;
#include "spec/macro.def"
#undef MACRO_NUMBER

/// The same numbers as rows.
struct MacroNumber {
  std::string_view name;
  std::uint32_t value = 0;
  std::string_view unit; ///< may be empty
  std::string_view source;
  std::string_view summary;
};

inline constexpr MacroNumber macro_numbers[] = {
#define MACRO_NUMBER(type, name, value, unit, source, summary)                                     \
  {#name, value, unit, source, summary},
#include "spec/macro.def"
#undef MACRO_NUMBER
};

enum class MacroIdKind : std::uint8_t { None, System, User, Stream, Temporary };

constexpr MacroIdKind macro_id_kind(std::uint8_t id) {
  if (id == macro_id_none)
    return MacroIdKind::None;
  if (id <= macro_id_system_last)
    return MacroIdKind::System;
  if (id <= macro_id_user_last)
    return MacroIdKind::User;
  return id == macro_id_stream ? MacroIdKind::Stream : MacroIdKind::Temporary;
}

namespace macro_detail {

inline constexpr MacroWord stabilization_words[] = {{"off", 0}, {"on", 1}, {"on_without_reset", 2}};
inline constexpr MacroWord motor_words[] = {
    {"off", 0}, {"forward", 1}, {"reverse", 2}, {"brake", 3}, {"ignore", 4}};
inline constexpr MacroWord collision_words[] = {{"off", 0}};

constexpr MacroOperand number(std::string_view name, MacroUnit unit, std::uint8_t width,
                              std::int32_t minimum, std::int32_t maximum) {
  return {name, MacroOperandKind::Number, unit, width, minimum < 0, minimum, maximum, nullptr, 0};
}

template <std::size_t N>
constexpr MacroOperand choice(std::string_view name, const MacroWord (&words)[N]) {
  return {name, MacroOperandKind::Number, MacroUnit::None, 1, false, 0, N - 1, words, N};
}

constexpr MacroOperand delay(std::uint8_t width, std::int32_t maximum) {
  return {
      "delay", MacroOperandKind::Delay, MacroUnit::Milliseconds, width, false, 0, maximum, nullptr,
      0};
}

template <class... Operand>
constexpr MacroCommandInfo with_operands(MacroCommandInfo row, Operand... operands) {
  static_assert(sizeof...(operands) <= macro_max_operands);
  row.operand_count = sizeof...(operands);
  std::size_t i = 0;
  ((row.operand[i++] = operands), ...);
  for (const auto& operand : row) {
    row.length = static_cast<std::uint8_t>(row.length + operand.width);
    row.variable_length = row.variable_length || operand.kind == MacroOperandKind::Text;
    row.has_pcd = operand.kind == MacroOperandKind::Delay && operand.width == 1;
  }
  return row;
}

constexpr MacroCommandInfo row(MacroCommand command, std::uint8_t code, std::string_view mnemonic,
                               std::string_view title, MacroWait wait, MacroBackground background,
                               MacroPlace place, std::uint8_t executive, std::string_view source,
                               std::string_view summary, std::string_view example) {
  MacroCommandInfo info;
  info.command = command;
  info.code = code;
  info.mnemonic = mnemonic;
  info.title = title;
  info.wait = wait;
  info.background = background;
  info.place = place;
  info.executive = executive;
  info.source = source;
  info.summary = summary;
  info.example = example;
  return info;
}

} // namespace macro_detail

// clang-format off
#define OPERANDS(...) (base __VA_OPT__(,) __VA_ARGS__)
#define BYTE(name) macro_detail::number(name, MacroUnit::None, 1, 0, 255)
#define SPEED BYTE("speed")
#define HEADING macro_detail::number("heading", MacroUnit::Degrees, 2, 0, 359)
#define ANGLE macro_detail::number("angle", MacroUnit::Degrees, 2, -32768, 32767)
#define TIME macro_detail::number("time", MacroUnit::Milliseconds, 2, 0, 65535)
#define TIMEOUT macro_detail::number("timeout", MacroUnit::Milliseconds, 2, 0, 65535)
#define METHOD macro_detail::number("method", MacroUnit::None, 1, 0, 1)
#define DEAD_TIME macro_detail::number("dead_time", MacroUnit::Ticks10ms, 1, 0, 255)
#define PCD macro_detail::delay(1, 255)
#define LONG_DELAY macro_detail::delay(2, 65535)
#define STABILIZATION macro_detail::choice("mode", macro_detail::stabilization_words)
#define MOTOR_MODE(name) macro_detail::choice(name, macro_detail::motor_words)
#define TARGET MacroOperand{"target", MacroOperandKind::MacroId, MacroUnit::None, 1, false, 0, 255, nullptr, 0}
#define COLLISION_TARGET MacroOperand{"target", MacroOperandKind::MacroId, MacroUnit::None, 1, false, 0, 255, macro_detail::collision_words, 1}
#define TEXT MacroOperand{"text", MacroOperandKind::Text, MacroUnit::None, 2, false, 0, 65535, nullptr, 0}

/// Every command, by ascending code.
inline constexpr MacroCommandInfo macro_commands[] = {
#define MACRO_COMMAND(Name, code, mnemonic, wait, background, place, executive, title, source, operands, summary, example) \
  [] { constexpr auto base = macro_detail::row(MacroCommand::Name, code, mnemonic, title, MacroWait::wait, MacroBackground::background, \
                                               MacroPlace::place, executive, source, summary, example); \
       return macro_detail::with_operands operands; }(),
#include "spec/macro.def"
#undef MACRO_COMMAND
};

#undef OPERANDS
#undef BYTE
#undef SPEED
#undef HEADING
#undef ANGLE
#undef TIME
#undef TIMEOUT
#undef METHOD
#undef DEAD_TIME
#undef PCD
#undef LONG_DELAY
#undef STABILIZATION
#undef MOTOR_MODE
#undef TARGET
#undef COLLISION_TARGET
#undef TEXT

inline constexpr MacroFlagInfo macro_flags[] = {
#define MACRO_FLAG(Name, bit, word, name, summary) {MacroFlag::Name, bit, word, name, summary},
#include "spec/macro.def"
#undef MACRO_FLAG
};

inline constexpr MacroParameterInfo macro_parameters[] = {
#define MACRO_PARAMETER(Name, index, word, summary) {MacroParameter::Name, index, word, summary},
#include "spec/macro.def"
#undef MACRO_PARAMETER
};
// clang-format on

namespace macro_detail {

inline constexpr std::uint8_t no_row = 0xFF;

/// Maps a code to its row, for the decoder's inner loop.
inline constexpr auto row_of_code = [] {
  std::array<std::uint8_t, 256> rows{};
  for (auto& row : rows)
    row = no_row;
  std::uint8_t next = 0;
  for (const auto& info : macro_commands)
    rows[info.code] = next++;
  return rows;
}();

inline constexpr std::size_t slots = 256;

/// The first slot to probe for a mnemonic; the search continues upwards to the first empty slot.
constexpr std::size_t slot_of(std::string_view mnemonic) {
  const auto at = [&](std::size_t i) { return static_cast<unsigned char>(mnemonic[i]); };
  return (at(0) * 7U + at(mnemonic.size() / 2) * 31U + at(mnemonic.size() - 1) * 3U +
          mnemonic.size()) %
         slots;
}

/// Maps a mnemonic to its row, for the parser's inner loop.
inline constexpr auto row_of_mnemonic = [] {
  std::array<std::uint8_t, slots> rows{};
  for (auto& row : rows)
    row = no_row;
  std::uint8_t next = 0;
  for (const auto& info : macro_commands) {
    auto slot = slot_of(info.mnemonic);
    while (rows[slot % slots] != no_row)
      ++slot;
    rows[slot % slots] = next++;
  }
  return rows;
}();

constexpr bool codes_ascend() {
  for (std::size_t i = 1; i < std::size(macro_commands); ++i)
    if (macro_commands[i - 1].code >= macro_commands[i].code)
      return false;
  return true;
}

constexpr bool mnemonics_are_unique() {
  for (const auto& a : macro_commands)
    for (const auto& b : macro_commands)
      if (a.command != b.command && a.mnemonic == b.mnemonic)
        return false;
  return true;
}

constexpr bool operands_are_well_formed() {
  for (const auto& info : macro_commands)
    for (const auto& operand : info) {
      const bool last = &operand == info.end() - 1;
      if (operand.minimum > operand.maximum || operand.width < 1 || operand.width > 2)
        return false;
      if (operand.kind == MacroOperandKind::Delay && !(last && info.wait == MacroWait::Operand))
        return false;
      if (operand.kind == MacroOperandKind::Text && info.operand_count != 1)
        return false;
      for (const auto& other : info)
        if (&other != &operand && other.name == operand.name)
          return false;
    }
  return true;
}

constexpr bool flags_are_the_eight_bits() {
  std::uint8_t all = 0;
  for (const auto& flag : macro_flags) {
    if ((all & flag.bit) != 0)
      return false;
    all = static_cast<std::uint8_t>(all | flag.bit);
  }
  return all == 0xFF;
}

static_assert(codes_ascend());
static_assert(mnemonics_are_unique());
static_assert(operands_are_well_formed());
static_assert(flags_are_the_eight_bits());

} // namespace macro_detail

/// The row of a command.
constexpr const MacroCommandInfo& info(MacroCommand command) {
  return macro_commands[macro_detail::row_of_code[static_cast<std::uint8_t>(command)]];
}

constexpr const MacroFlagInfo& info(MacroFlag flag) {
  std::size_t row = 0;
  while (macro_flags[row].flag != flag)
    ++row;
  return macro_flags[row];
}

constexpr const MacroParameterInfo& info(MacroParameter parameter) {
  return macro_parameters[static_cast<std::size_t>(parameter)];
}

/// Finds the row of a command byte; null if the byte is not a command.
constexpr const MacroCommandInfo* find_macro_command(std::uint8_t code) {
  const auto row = macro_detail::row_of_code[code];
  return row == macro_detail::no_row ? nullptr : &macro_commands[row];
}

/// Finds the row of a mnemonic; null if there is none. Case counts.
constexpr const MacroCommandInfo* find_macro_command(std::string_view mnemonic) {
  if (mnemonic.empty())
    return nullptr;
  for (auto slot = macro_detail::slot_of(mnemonic);; ++slot) {
    const auto row = macro_detail::row_of_mnemonic[slot % macro_detail::slots];
    if (row == macro_detail::no_row)
      return nullptr;
    if (macro_commands[row].mnemonic == mnemonic)
      return &macro_commands[row];
  }
}

/// Finds the row of a flag's word; null if there is none.
constexpr const MacroFlagInfo* find_macro_flag(std::string_view word) {
  for (const auto& info : macro_flags)
    if (info.word == word)
      return &info;
  return nullptr;
}

/// Finds the parameter with this index.
constexpr std::optional<MacroParameter> find_macro_parameter(std::uint8_t index) {
  if (index < std::size(macro_parameters))
    return macro_parameters[index].parameter;
  return std::nullopt;
}

/// True if `flags` include `flag`.
constexpr bool has_flag(std::uint8_t flags, MacroFlag flag) {
  return (flags & static_cast<std::uint8_t>(flag)) != 0;
}

/// Prints a unit: `ms`, `10 ms`, `deg`, or nothing.
std::string_view to_string(MacroUnit unit);

/// True if the documents allow `value` for the operand: it is in range and, for macro identifiers,
/// not the stream macro, which cannot be a target.
constexpr bool is_documented(const MacroOperand& operand, std::int32_t value) {
  if (operand.kind == MacroOperandKind::MacroId && value == macro_id_stream)
    return false;
  return value >= operand.minimum && value <= operand.maximum;
}

} // namespace orb::spec
