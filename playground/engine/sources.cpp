#include "playground/engine/sources.h"

#include "assembler/assemble.h"
#include "base/render.h"
#include "compiler/check.h"
#include "compiler/text/image.h"
#include "editor/language.h"
#include "editor/languages/structured/block_rows.h"
#include "protocol/macro.h"
#include "report/course.h"
#include "run/check_files.h"
#include "structured/lift/lift.h"
#include "testing/suite.h"

#include <fmt/format.h>

namespace orb::playground {
namespace {

const editor::LanguageService& service_of(const run::SourceFile& file) {
  if (!file.language)
    return editor::test_service;
  switch (*file.language) {
  case run::Language::Basic: return editor::basic_service;
  case run::Language::Structured: return editor::structured_service;
  case run::Language::Macro: break;
  }
  return editor::macro_service;
}

} // namespace

Answer check(Request& request) {
  const auto sources = request.sources();
  if (!sources)
    return tl::unexpected(sources.error());
  auto found = run::check_files(*sources, {}, {}, request.files);
  testing::check_tests(*sources, found.files, request.files);
  return render_json(found.files, request.said.say());
}

Answer format(Request& request) {
  const auto sources = request.sources();
  if (!sources)
    return tl::unexpected(sources.error());
  const auto& file = sources->front();
  if (report::is_course(file.path))
    return refuse(ExitCode::Usage, fmt::format("{} is a drawing", file.path));
  if (const auto text = service_of(file).format(file.source))
    return print({{"text", *text}});
  return tl::unexpected(Problem{ExitCode::BadInput, fmt::format("{} cannot be laid out", file.path),
                                check(request).value_or("")});
}

Answer build(Request& request) {
  const auto inputs = request.inputs();
  if (!inputs)
    return tl::unexpected(inputs.error());
  const auto* program = run::first_with_program(*inputs);
  if (program == nullptr)
    return refuse(ExitCode::Usage, fmt::format("{} is no program", request.names.front()));
  return print({{"name", fmt::format("{}.img", stem(program->source->name()))},
                {"bytes", bytes_json(as_bytes(program->program->image.bytes))}});
}

Answer assemble(Request& request) {
  const auto inputs = request.inputs();
  if (!inputs)
    return tl::unexpected(inputs.error());
  auto macros = ordered_json::array();
  for (const auto& input : *inputs)
    for (const auto& macro : input.macros)
      macros.push_back({{"name", macro.name},
                        {"id", macro.image.id},
                        {"sphero", bytes_json(macro.image.body)},
                        {"bin", bytes_json(protocol::encode(macro.image))}});
  if (macros.empty())
    return refuse(ExitCode::Usage, fmt::format("{} holds no macro", request.names.front()));
  return print({{"name", fmt::format("{}.bin", stem(request.names.front()))},
                {"bytes", macros.front()["bin"]},
                {"macros", macros}});
}

Answer tree(Request& request) {
  const auto sources = request.sources();
  if (!sources)
    return tl::unexpected(sources.error());
  const auto& file = sources->front();
  if (&service_of(file) != &editor::structured_service)
    return refuse(ExitCode::Usage, fmt::format("{} is no structured program", file.path));
  if (const auto refused = compiler::refuse_text(file.source.text()))
    return refuse(ExitCode::BadInput, request.said.say()(refused->message));
  return editor::structured_tree(file.source.text());
}

Answer words(Request&) {
  return editor::structured_vocabulary();
}

Answer lift(Request& request) {
  const auto sources = request.sources();
  if (!sources)
    return tl::unexpected(sources.error());
  const auto& file = sources->front();
  if (&service_of(file) != &editor::basic_service)
    return refuse(ExitCode::Usage, fmt::format("{} is no program with line numbers", file.path));
  const auto lifted = structured::lift(compiler::check(file.source.text(), {}));
  if (lifted.text.empty())
    return tl::unexpected(Problem{ExitCode::BadInput, fmt::format("{} has errors", file.path),
                                  render_json({{&file.source, lifted.findings, {}}})});
  return print({{"text", lifted.text}});
}

} // namespace orb::playground
