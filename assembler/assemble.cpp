#include "assembler/assembler.h"

namespace orb::assembler {

Assembler::Assembler(const Source& source, Folding folding)
    : source_(source), folding_(folding), program_(parse(source.text())) {
  assembly_.diagnostics = std::move(program_.diagnostics);
}

Assembly Assembler::run() {
  collect_names();
  if (assembly_.macros.empty())
    begin_unnamed();
  for (const auto& statement : program_.statements)
    add(statement);
  end_macro();
  if (program_.statements.size() == constants_ && assembly_.diagnostics.empty())
    report(rules::EmptyFile, {0, 0}, "the file has no macro command",
           "write one, such as `marker 20`");
  sort_by_place(assembly_.diagnostics);
  return std::move(assembly_);
}

Diagnostic& Assembler::report(const Rule& rule, Span span, std::string message, std::string help) {
  assembly_.diagnostics.push_back(finding(rule, span, std::move(message), std::move(help)));
  return assembly_.diagnostics.back();
}

const Value* Assembler::values(const Statement& statement) const {
  return program_.values.data() + statement.first;
}

void Assembler::collect_names() {
  for (const auto& statement : program_.statements) {
    if (statement.kind == Statement::Kind::Const)
      define_constant(statement);
    else if (statement.kind == Statement::Kind::Macro)
      define_macro(statement);
  }
}

void Assembler::define(Span span, Name name) {
  name.span = span;
  const auto [old, is_new] = names_.emplace(text(span), name);
  if (!is_new)
    report(rules::DuplicateName, span, fmt::format("`{}` is defined twice", text(span)))
        .notes.push_back({old->second.span, "first here"});
}

void Assembler::define_constant(const Statement& statement) {
  ++constants_;
  const auto* value = values(statement);
  if (statement.count != 1 || value->name.size() == 0) {
    report(rules::Syntax, statement.span, "`.const` takes a name and a value",
           "write `.const NAME = 100`");
    return;
  }
  Name name;
  name.value = *value;
  if (value->kind == Value::Kind::Word)
    if (const auto* other = find_name(text(value->span));
        other != nullptr && other->kind == Name::Kind::Constant)
      name.value = other->value;
  define(value->name, name);
}

const Name* Assembler::find_name(std::string_view word) const {
  const auto found = names_.find(word);
  return found == names_.end() ? nullptr : &found->second;
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
    if (assembly_.macros.size() == 1)
      reserve();
    return;
  case Statement::Kind::Command:
  case Statement::Kind::Raw:
  case Statement::Kind::NoEnd: break;
  }
  if (!inside_) {
    if (!outside_reported_)
      report(rules::OutsideMacro, statement.span, "this is above the first `.macro` line",
             "move it below a `.macro` line, or add one above it");
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

void Assembler::add_raw(const Statement& statement) {
  auto& out = macro();
  const auto begin = static_cast<std::uint32_t>(out.body.size());
  for (const auto* value = values(statement); value != values(statement) + statement.count;
       ++value) {
    static constexpr auto byte =
        spec::macro_detail::number("byte", MacroUnit::None, 1, 0, UINT8_MAX);
    if (value->name.size() != 0)
      report(rules::UnknownOperand, value->name, "`.raw` takes bytes, not names");
    else if (const auto number = resolve(*value, byte, ".raw"))
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
      report(rules::AfterEnd, statement.span, "this is after `end`",
             "remove `end`, or start another macro with `.macro`");
    after_end_reported_ = true;
    return;
  }
  const spec::MacroCommandInfo* info = statement.info;
  std::array<const Value*, spec::macro_max_operands> bound{};
  std::array<std::int32_t, spec::macro_max_operands> value{};
  bool good = bind(statement, *info, bound);
  if (good) {
    if (info->command == MacroCommand::Roll && bound[2] != nullptr)
      info = roll_for(*bound[2]);
    for (std::size_t i = 0; i < info->operand_count; ++i) {
      if (bound[i] == nullptr || info->operand[i].kind == MacroOperandKind::Text)
        continue;
      const auto number = resolve(*bound[i], info->operand[i], info->mnemonic);
      good = good && number.has_value();
      value[i] = number.value_or(0);
    }
  }
  const auto operand = statement.count > 0 ? values(statement)->span : Span{};
  if (info->variable_length) {
    const auto comment = good ? read_text(*bound[0]) : std::string();
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
                      const std::array<std::int32_t, spec::macro_max_operands>& value,
                      std::string_view comment) {
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

namespace {

std::optional<Diagnostic> unreadable(const Source& source) {
  const auto text = source.text();
  if (text.empty())
    return finding(rules::EmptyFile, {0, 0}, "the file is empty",
                   "write a command, such as `marker 20`");
  if (text.size() > largest_source)
    return finding(
        rules::SourceTooLarge, {0, 0},
        fmt::format("the file is {} bytes; the limit is {}", text.size(), largest_source));
  // One pass without branches first: nearly every file is text.
  bool any = false;
  for (const char c : text)
    any |= is_binary_byte[static_cast<unsigned char>(c)];
  if (!any)
    return std::nullopt;
  const auto* const binary = std::find_if(text.data(), text.data() + text.size(), [](char c) {
    return is_binary_byte[static_cast<unsigned char>(c)];
  });
  const auto at = static_cast<std::uint32_t>(binary - text.data());
  return finding(
      rules::BinaryFile, {at, at + 1},
      fmt::format("the file is not text: byte {:02X}h", static_cast<unsigned char>(*binary)),
      "`orb disasm` reads the bytes of a macro");
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
