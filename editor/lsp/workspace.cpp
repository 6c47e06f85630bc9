#include "editor/lsp/workspace.h"

#include "base/text/text.h"
#include "run/input.h"
#include "testing/suite.h"

#include <utility>

namespace orb::editor {
namespace {

int severity_number(Severity severity) {
  switch (severity) {
  case Severity::Error: return 1;
  case Severity::Warning: return 2;
  case Severity::Info: break;
  }
  return 3;
}

} // namespace

const LanguageService& language_of(std::string_view id, std::string_view uri) {
  if (id == "orbtest" || testing::is_test(uri))
    return test_service;
  if (id == "orbstimulus" || has_ending(uri, ".stimulus"))
    return stimulus_service;
  const auto word = id == "orbmacro" || id == "macro"             ? std::string_view("macro")
                    : id == "orbbasic" || id == "basic"           ? std::string_view("basic")
                    : id == "orbstructured" || id == "structured" ? std::string_view("structured")
                                                                  : std::string_view();
  switch (run::language_of(uri, word).value_or(run::Language::Basic)) {
  case run::Language::Basic: return basic_service;
  case run::Language::Structured: return structured_service;
  case run::Language::Macro: return macro_service;
  }
  return basic_service;
}

Workspace::Workspace(structured::Files* disk, Folders* folders, Say told)
    : say(std::move(told)), disk_(disk), folders_(folders) {
  options.files = this;
}

std::optional<std::string> Workspace::read(const std::string& path) {
  if (reads_ != nullptr)
    reads_->insert(path);
  for (const auto& [uri, document] : documents_)
    if (path_of_uri(uri) == path)
      return std::string(document.source.text());
  return disk_ != nullptr ? disk_->read(path) : std::nullopt;
}

Message Workspace::obstacle(const std::string& path) {
  return disk_ != nullptr ? disk_->obstacle(path) : Files::obstacle(path);
}

std::string Workspace::identity(const std::string& path) {
  return disk_ != nullptr ? disk_->identity(path) : Files::identity(path);
}

Document* Workspace::find(const std::string& uri) {
  const auto found = documents_.find(uri);
  return found == documents_.end() ? nullptr : &found->second;
}

std::vector<Diagnostic> Workspace::check(const Document& document) const {
  return document.language->check(document.source, options);
}

std::vector<Diagnostic> Workspace::check(Document& document) {
  document.reads.clear();
  reads_ = &document.reads;
  auto findings = std::as_const(*this).check(document);
  reads_ = nullptr;
  return findings;
}

LanguageOptions Workspace::surroundings(const std::vector<Source>& closed) const {
  auto all = options;
  for (const auto& program : closed)
    all.open.push_back(&program);
  for (const auto& [uri, document] : documents_)
    if (document.language == &structured_service)
      all.open.push_back(&document.source);
  return all;
}

/// Calls `visit` with path and text of each file in the open folders that is not an open document.
void Workspace::each_closed_file(
    const std::function<void(const std::string&, std::string)>& visit) const {
  if (folders_ == nullptr || disk_ == nullptr)
    return;
  for (const auto& root : roots)
    for (const auto& path : folders_->sources(root)) {
      auto text = documents_.contains(uri_of_path(path)) ? std::nullopt : disk_->read(path);
      if (text)
        visit(path, *std::move(text));
    }
}

std::vector<Source> Workspace::closed_programs(const Document& document) const {
  std::vector<Source> programs;
  if (document.language != &structured_service)
    return programs;
  each_closed_file([&](const std::string& path, std::string text) {
    if (&language_of("", uri_of_path(path)) == document.language)
      programs.emplace_back(path, std::move(text));
  });
  return programs;
}

std::string Workspace::uri_of(const Source& source) const {
  for (const auto& [uri, document] : documents_)
    if (uri == source.name() || path_of_uri(uri) == source.name())
      return uri;
  return uri_of_path(source.name());
}

Json diagnostic(const Workspace& space, const std::string& uri, const Document& document,
                const Diagnostic& one) {
  Json json{
      {"range", space.range(document.source, one.span)},
      {"severity", severity_number(one.severity)},
      {"source", "orb"},
      {"message", space.say(one.message) + (one.help.empty() ? "" : "\n" + space.say(one.help))}};
  if (one.rule != nullptr)
    json["code"] = one.rule->id;
  for (const auto& note : one.notes)
    json["relatedInformation"].push_back(
        {{"location", {{"uri", uri}, {"range", space.range(document.source, note.span)}}},
         {"message", space.say(note.message)}});
  return json;
}

} // namespace orb::editor
