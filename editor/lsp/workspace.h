#pragma once

#include "editor/language.h"
#include "editor/languages/shape.h"
#include "editor/lsp/language_server.h"
#include "editor/wording.h"

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace orb::editor {

/// A text open in the editor.
struct Document {
  Source source;
  const LanguageService* language = nullptr;
  std::optional<std::int64_t> version;
  std::set<std::string> reads = {}; ///< files that its findings depend on

  const LanguageShape& shape() const { return *language->shape; }
};

/// The language by the editor's language id, else by file extension.
const LanguageService& language_of(std::string_view id, std::string_view uri);

/// The open documents and the files around them on disk.
class Workspace final : public structured::Files, public Wording {
public:
  /// Both must outlive it; null: no files on disk. `told` words the findings.
  Workspace(structured::Files* disk, Folders* folders, Say told);

  // Reads included files: an open document, else the file on disk.
  std::optional<std::string> read(const std::string& path) override;
  Message obstacle(const std::string& path) override;
  std::string identity(const std::string& path) override;

  std::map<std::string, Document>& documents() { return documents_; }
  const std::map<std::string, Document>& documents() const { return documents_; }
  /// Returns null if it is not open.
  Document* find(const std::string& uri);

  /// Checks a document, and records the files that its findings depend on.
  std::vector<Diagnostic> check(Document& document);
  /// The same without recording.
  std::vector<Diagnostic> check(const Document& document) const;

  /// The options, with all open structured programs and `closed`.
  LanguageOptions surroundings(const std::vector<Source>& closed = {}) const;
  /// Programs on disk that may include a structured program.
  std::vector<Source> closed_programs(const Document& document) const;
  /// Calls `visit` with path and text of each file in the open folders that is not an open
  /// document.
  void each_closed_file(const std::function<void(const std::string&, std::string)>& visit) const;
  /// The URI of a file, made from its path; an open text is named by its URI.
  std::string uri_of(const Source& source) const;

  LanguageOptions options;
  Say say;
  std::vector<std::string> roots; ///< paths of the editor's open folders

private:
  structured::Files* disk_;
  Folders* folders_;
  std::set<std::string>* reads_ = nullptr; ///< where `read` records requested paths
  std::map<std::string, Document> documents_;
};

/// A finding in the protocol's form.
Json diagnostic(const Workspace& space, const std::string& uri, const Document& document,
                const Diagnostic& one);

} // namespace orb::editor
