#include "base/render.h"

#include <nlohmann/json.hpp>

namespace orb {
namespace {

using Json = nlohmann::ordered_json;

void put_range(Json& json, const Source& source, Span span) {
  const auto from = source.position(span.begin);
  const auto to = source.position(span.end);
  json["line"] = from.line;
  json["column"] = from.column;
  json["endLine"] = to.line;
  json["endColumn"] = to.column;
}

Json fix_json(const Source& source, const Fix& fix, const Say& say) {
  Json json;
  json["title"] = say(fix.title);
  json["safety"] = fix.safety == Safety::Safe ? "safe" : "unsafe";
  json["edits"] = Json::array();
  for (const auto& edit : fix.edits) {
    Json entry;
    put_range(entry, source, edit.span);
    entry["text"] = edit.text;
    json["edits"].push_back(std::move(entry));
  }
  return json;
}

Json diagnostic_json(const Source& source, const Diagnostic& diagnostic, const Say& say) {
  Json json;
  json["file"] = source.name();
  put_range(json, source, diagnostic.span);
  if (diagnostic.basic_line)
    json["basicLine"] = *diagnostic.basic_line;
  json["rule"] = diagnostic.rule->id;
  json["severity"] = to_string(diagnostic.severity);
  json["message"] = say(diagnostic.message);
  if (diagnostic.rule->robot_error != 0)
    json["robotError"] = diagnostic.rule->robot_error;
  if (!diagnostic.help.empty())
    json["help"] = say(diagnostic.help);
  for (const auto& note : diagnostic.notes) {
    Json entry;
    put_range(entry, source, note.span);
    entry["message"] = say(note.message);
    json["notes"].push_back(std::move(entry));
  }
  if (diagnostic.fix)
    json["fix"] = fix_json(source, *diagnostic.fix, say);
  return json;
}

} // namespace

std::string render_json(const std::vector<FileFindings>& files, const Say& say) {
  Json json;
  json["schema"] = "orb.check/1";
  json["diagnostics"] = Json::array();
  Json sizes = Json::object();
  for (const auto& file : files) {
    for (const auto& diagnostic : file.diagnostics)
      json["diagnostics"].push_back(diagnostic_json(*file.source, diagnostic, say));
    if (file.built_size)
      sizes[file.source->name()] = *file.built_size;
  }
  const auto counts = count(files);
  json["summary"] = {{"files", files.size()},
                     {"errors", counts.errors},
                     {"warnings", counts.warnings},
                     {"bytes", std::move(sizes)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

} // namespace orb
