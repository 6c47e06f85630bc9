#include "bytecode/chunk.h"

#include "spec/basic.h"
#include "spec/limits.h"

#include <array>
#include <fmt/format.h>
#include <iterator>

namespace orb::bytecode {

namespace {

std::array<std::uint16_t, 4> operands(const Instruction& instruction) {
  return {instruction.a, instruction.b, instruction.c, instruction.d};
}

std::optional<std::string> verify(const Chunk& chunk, const Instruction& instruction) {
  const auto& row = info(instruction.op);
  const auto values = operands(instruction);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const char kind = row.operands[i];
    const std::size_t limit = kind == 'w' ? chunk.first_constant() : chunk.register_count();
    const bool is_register = kind == 'r' || kind == 'w' || kind == 'p';
    if (is_register && values[i] + (kind == 'p' ? 1u : 0u) >= limit)
      return fmt::format("register {} does not exist", values[i]);
    if (kind == 'x' && values[i] >= chunk.texts.size())
      return fmt::format("text {} does not exist", values[i]);
  }
  if (row.has_target() && instruction.target >= chunk.code.size())
    return fmt::format("target {} is outside the code", instruction.target);
  if (instruction.ends_line && row.ends != Ends::Either)
    return "it cannot say whether the line ends";
  return std::nullopt;
}

/// Checks what the operand row cannot express: counts of registers and rows, indices into tables.
std::optional<std::string> verify_meaning(const Chunk& chunk, std::size_t at) {
  const auto& instruction = chunk.code[at];
  const auto registers_from = [&](std::uint16_t first, std::uint16_t count) {
    return std::size_t{first} + count <= chunk.register_count();
  };
  const auto variable = [](std::uint16_t index) {
    return index < index_variable + 1 || index == element_by_index;
  };
  if (instruction.op == Op::OnGoto || instruction.op == Op::OnGosub) {
    for (std::size_t i = 1; i <= instruction.b; ++i)
      if (at + i >= chunk.code.size() || chunk.code[at + i].op != Op::Target)
        return "rows of the list are missing";
  } else if (instruction.op == Op::Trap) {
    if (!spec::find_error(instruction.a))
      return "there is no such error";
  } else if (instruction.op == Op::Perform) {
    if (instruction.a >= spec::statements.size() || !registers_from(instruction.b, instruction.c))
      return "there is no such statement, or its arguments are not registers";
  } else if (instruction.op == Op::SetData) {
    if (!registers_from(instruction.a, instruction.b) ||
        instruction.b > spec::value_of(spec::Limit::DataValues))
      return "the data are too many, or no registers";
  } else if (instruction.op == Op::ReadSystem) {
    if (instruction.b >= spec::variables.size())
      return "there is no such system variable";
  } else if (instruction.op == Op::WriteSystem) {
    if (instruction.a >= spec::variables.size())
      return "there is no such system variable";
    if (!instruction.ends_line &&
        (at + 1 >= chunk.code.size() || chunk.code[at + 1].op != Op::Goto))
      return "a line goes on after a system variable was set";
  } else if (instruction.op == Op::Input || instruction.op == Op::InputTimed) {
    if (!variable(instruction.a))
      return "the input has no variable";
  }
  return std::nullopt;
}

} // namespace

std::optional<std::string> verify(const Chunk& chunk) {
  if (chunk.code.empty() || chunk.code.back().op != Op::EndOfProgram)
    return "the code does not end with EndOfProgram";
  if (std::size_t{first_temporary} + chunk.temporaries + chunk.constants.size() >= element_by_index)
    return "too many registers";
  for (std::size_t at = 0; at < chunk.code.size(); ++at) {
    if (static_cast<std::size_t>(chunk.code[at].op) >= ops.size())
      return fmt::format("instruction {}: there is no such operation", at);
    auto problem = verify(chunk, chunk.code[at]);
    if (!problem)
      problem = verify_meaning(chunk, at);
    if (problem)
      return fmt::format("instruction {} ({}): {}", at, info(chunk.code[at].op).name, *problem);
  }
  std::uint32_t expected = 0;
  for (const auto& line : chunk.lines) {
    if (line.begin < expected || line.begin >= chunk.code.size())
      return fmt::format("line {} begins at {}", line.number, line.begin);
    expected = line.begin + 1;
  }
  return std::nullopt;
}

namespace {

std::string register_name(const Chunk& chunk, std::uint16_t index) {
  if (index <= index_variable)
    return std::string(1, spec::letter_name(index));
  if (index < first_temporary)
    return fmt::format("Z({})", index - first_element + 1);
  if (index < chunk.first_constant())
    return fmt::format("t{}", index - first_temporary);
  if (index < chunk.register_count())
    return fmt::format("{}", chunk.constants[index - chunk.first_constant()]);
  return fmt::format("r{}", index);
}

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte >= 0x7F || c == '\\')
      fmt::format_to(std::back_inserter(out), "\\x{:02X}", byte);
    else
      out += c;
  }
  return out + '"';
}

void write(std::string& out, const Chunk& chunk, std::size_t at) {
  const auto& instruction = chunk.code[at];
  const auto& row = info(instruction.op);
  fmt::format_to(std::back_inserter(out), "{:5} {}", at, row.name);
  const auto values = operands(instruction);
  for (std::size_t i = 0; i < values.size(); ++i) {
    switch (row.operands[i]) {
    case 'r':
    case 'p':
    case 'w': out += ' ' + register_name(chunk, values[i]); break;
    case 'n': fmt::format_to(std::back_inserter(out), " #{}", values[i]); break;
    case 'x':
      out += ' ' + (values[i] < chunk.texts.size() ? quoted(chunk.texts[values[i]]) : "?");
      break;
    }
  }
  if (row.has_target())
    fmt::format_to(std::back_inserter(out), " -> {}", instruction.target);
  out += instruction.ends_line ? " .\n" : "\n";
}

} // namespace

std::string listing(const Chunk& chunk, std::size_t line) {
  std::string out;
  for (auto at = chunk.begin(line); at < chunk.begin(line + 1); ++at)
    write(out, chunk, at);
  return out;
}

std::string listing(const Chunk& chunk) {
  std::string out;
  for (std::size_t line = 0; line < chunk.lines.size(); ++line)
    out += fmt::format("{}\n", chunk.lines[line].number) + listing(chunk, line);
  write(out, chunk, chunk.code.size() - 1);
  return out;
}

} // namespace orb::bytecode
