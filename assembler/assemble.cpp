#include "assembler/assemble.h"

#include "assembler/constants.h"
#include "assembler/operands.h"
#include "assembler/text/parse_macro.h"
#include "assembler/text/rules.h"
#include "assembler/text/texts.h"
#include "base/text/utf8.h"

#include <algorithm>
#include <fmt/format.h>

namespace orb::assembler {

namespace {

using spec::MacroCommand;
using spec::MacroOperandKind;
using Origin = PlacedCommand::Origin;
using OperandValues = std::array<std::int32_t, spec::macro_max_operands>;

/// Assembles the commands of a program into its macros.
class Assembler {
public:
  Assembler(const Source& source, Folding folding)
      : folding_(folding), program_(parse(source.text())),
        findings_(std::move(program_.diagnostics)), names_(program_, findings_),
        operands_(program_, names_, findings_), macros_(names_.macros()) {}

  Assembly run();

private:
  AssembledMacro& macro() { return macros_[current_]; }

  void begin_unnamed();

  /// Reserves memory for the rest of the file.
  void reserve();

  void add(const Statement& statement);

  void end_macro();

  void add_raw(const Statement& statement);

  void add_command(const Statement& statement);

  void place(const spec::MacroCommandInfo& info, Span span, Span operand, Origin origin,
             const OperandValues& value, std::string_view comment);

  /// Folds a delay into the command before it. Returns false if that command has no delay of its
  /// own, or the sum does not fit.
  bool fold(std::int32_t time_ms);

  Folding folding_;
  Program program_;
  Findings findings_;
  Names names_;
  Operands operands_;
  std::vector<AssembledMacro> macros_;
  std::size_t current_ = 0;
  bool inside_ = false;
  bool no_end_ = false;
  bool outside_reported_ = false;
  bool after_end_reported_ = false;
};

Assembly Assembler::run() {
  if (macros_.empty())
    begin_unnamed();
  for (const auto& statement : program_.statements)
    add(statement);
  end_macro();
  const bool says_nothing =
      std::all_of(program_.statements.begin(), program_.statements.end(),
                  [](const Statement& one) { return one.kind == Statement::Kind::Const; });
  if (says_nothing && findings_.all().empty())
    findings_.add(rules::EmptyFile, {0, 0}, texts::NoCommands(), texts::WriteOne());
  sort_by_place(findings_.all());
  return {std::move(macros_), std::move(findings_.all())};
}

void Assembler::begin_unnamed() {
  macros_.emplace_back();
  inside_ = true;
  reserve();
}

void Assembler::reserve() {
  macro().commands.reserve(program_.statements.size() + 1);
  macro().body.reserve(program_.statements.size() * 5);
}

void Assembler::add(const Statement& statement) {
  switch (statement.kind) {
  case Statement::Kind::Const: return;
  case Statement::Kind::Macro:
    if (inside_) {
      end_macro();
      ++current_;
    }
    inside_ = true;
    if (macros_.size() == 1)
      reserve();
    return;
  case Statement::Kind::Command:
  case Statement::Kind::Raw:
  case Statement::Kind::NoEnd: break;
  }
  if (!inside_) {
    if (!outside_reported_)
      findings_.add(rules::OutsideMacro, statement.span, texts::AboveMacros(), texts::MoveBelow());
    outside_reported_ = true;
    return;
  }
  if (statement.kind == Statement::Kind::NoEnd)
    no_end_ = true;
  else if (statement.kind == Statement::Kind::Raw)
    add_raw(statement);
  else
    add_command(statement);
}

void Assembler::end_macro() {
  if (!inside_)
    return;
  auto& ended = macro();
  if (!ended.has_end && !no_end_) {
    place(spec::info(MacroCommand::End), {}, {}, Origin::Supplied, {}, {});
    ended.has_end = true;
  }
  no_end_ = false;
  after_end_reported_ = false;
}

void Assembler::add_raw(const Statement& statement) {
  auto& out = macro();
  const auto begin = static_cast<std::uint32_t>(out.body.size());
  for (const auto& value : program_.values_of(statement)) {
    static constexpr auto byte =
        spec::macro_detail::number("byte", spec::MacroUnit::None, 1, 0, UINT8_MAX);
    if (value.name.size() != 0)
      findings_.add(rules::UnknownOperand, value.name, texts::RawTakesBytes());
    else if (const auto number = operands_.resolve(value, byte, ".raw"))
      out.body.push_back(static_cast<std::uint8_t>(*number));
  }
  const ByteView raw = ByteView(out.body).subspan(begin);
  const auto listing = protocol::decode_macro_body(raw);
  if (listing.error) {
    PlacedCommand placed;
    placed.origin = Origin::Raw;
    placed.span = statement.span;
    placed.offset = begin;
    placed.size = static_cast<std::uint32_t>(raw.size());
    out.commands.push_back(placed);
    return;
  }
  for (const auto& step : listing.steps)
    out.commands.push_back({step.info, Origin::Raw, statement.span, statement.span,
                            begin + step.offset, step.size, step.value});
  out.has_end = listing.has_end;
}

void Assembler::add_command(const Statement& statement) {
  auto& out = macro();
  if (out.has_end && out.id != spec::macro_id_stream) {
    if (!after_end_reported_)
      findings_.add(rules::AfterEnd, statement.span, texts::ComesAfter("end"),
                    texts::StartAnother("end", ".macro"));
    after_end_reported_ = true;
    return;
  }
  const spec::MacroCommandInfo* info = statement.info;
  OperandValues value{};
  const auto bound = operands_.bind(statement, *info);
  bool good = bound.has_value();
  if (good) {
    if (const auto* delay = (*bound)[2]; info->command == MacroCommand::Roll && delay != nullptr)
      info = operands_.roll_for(*delay);
    for (std::size_t i = 0; i < info->operand_count; ++i) {
      const auto* given = (*bound)[i];
      if (given == nullptr || info->operand[i].kind == MacroOperandKind::Text)
        continue;
      const auto number = operands_.resolve(*given, info->operand[i], statement.info->mnemonic);
      good = good && number.has_value();
      value[i] = number.value_or(0);
    }
  }
  const auto values = program_.values_of(statement);
  const auto operand = values.empty() ? Span{} : values[0].span;
  if (info->variable_length) {
    const auto comment = good ? operands_.read_text(*bound->front()) : std::string();
    place(*info, statement.span, operand, good ? Origin::Written : Origin::Broken, value, comment);
    out.has_end = false;
    return;
  }
  if (good && folding_ == Folding::Fold && info->command == MacroCommand::Delay && fold(value[0]))
    return;
  place(*info, statement.span, operand, good ? Origin::Written : Origin::Broken, value, {});
  out.has_end = info->command == MacroCommand::End;
}

void Assembler::place(const spec::MacroCommandInfo& info, Span span, Span operand, Origin origin,
                      const OperandValues& value, std::string_view comment) {
  auto& out = macro();
  PlacedCommand placed{&info, origin, span, operand, static_cast<std::uint32_t>(out.body.size()),
                       0,     value};
  protocol::append_macro_command(out.body, info.command, std::span(value).first(info.operand_count),
                                 comment);
  placed.size = static_cast<std::uint32_t>(out.body.size()) - placed.offset;
  if (info.variable_length)
    placed.value[0] = static_cast<std::int32_t>(comment.size());
  out.commands.push_back(placed);
}

bool Assembler::fold(std::int32_t time_ms) {
  auto& out = macro();
  if (out.commands.empty())
    return false;
  auto& last = out.commands.back();
  if (last.origin != Origin::Written || last.info->operand_count == 0)
    return false;
  const auto delay = last.info->operand_count - 1U;
  if (last.info->operand[delay].kind != MacroOperandKind::Delay)
    return false;
  const auto total = last.value[delay] + time_ms;
  const auto* info = last.info;
  if (total > info->operand[delay].maximum && info->command == MacroCommand::Roll)
    info = &spec::info(MacroCommand::Roll2);
  if (total > info->operand[delay].maximum)
    return false;
  auto folded = last;
  folded.value[delay] = total;
  out.commands.pop_back();
  out.body.resize(folded.offset);
  place(*info, folded.span, folded.operand, Origin::Written, folded.value, {});
  return true;
}

std::optional<Diagnostic> unreadable(const Source& source) {
  const auto text = source.text();
  if (text.empty())
    return finding(rules::EmptyFile, {0, 0}, texts::FileIsEmpty(), texts::WriteCommand());
  if (text.size() > largest_source)
    return finding(rules::SourceTooLarge, {0, 0}, texts::FileTooLarge(text.size(), largest_source));
  // Scan once without branches: nearly every file is text.
  bool any = false;
  for (const char c : text)
    any |= is_binary_byte[static_cast<unsigned char>(c)];
  if (!any)
    return std::nullopt;
  const auto* const binary = std::find_if(text.data(), text.data() + text.size(), [](char c) {
    return is_binary_byte[static_cast<unsigned char>(c)];
  });
  const auto at = static_cast<std::uint32_t>(binary - text.data());
  return finding(rules::BinaryFile, {at, at + 1},
                 texts::NotText(fmt::format("{:02X}h", static_cast<unsigned char>(*binary))),
                 texts::ReadsBytes());
}

} // namespace

protocol::MacroImage AssembledMacro::image() const {
  return {id.value_or(spec::macro_id_temporary), flags.value_or(spec::macro_default_flags),
          extended_flags, body};
}

std::size_t AssembledMacro::framed_size() const {
  return 2 + (extended_flags ? 1 : 0) + body.size();
}

bool Assembly::has_errors() const {
  return any_error(diagnostics);
}

Assembly assemble(const Source& source, Folding folding) {
  if (auto problem = unreadable(source)) {
    Assembly assembly;
    assembly.diagnostics.push_back(std::move(*problem));
    return assembly;
  }
  return Assembler(source, folding).run();
}

} // namespace orb::assembler
