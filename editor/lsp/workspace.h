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

/// A text that the editor has open.
struct Document {
  Source source;
  const LanguageService* language = nullptr;
  std::optional<std::int64_t> version;
  std::set<std::string> reads = {}; ///< the paths that its findings were made from

  const LanguageShape& shape() const { return *language->shape; }
};

/// The language by the editor's word for it, else by the ending of the file's name.
const LanguageService& language_of(std::string_view id, std::string_view uri);

/// The documents that are open, and what lies beside them on the disk.
class Workspace final : public structured::Files, public Wording {
public:
  /// Both outlive it; null: nothing is on the disk. `told`: how findings are said.
  Workspace(structured::Files* disk, Folders* folders, Say told);

  // What programs include: an open document, else what the disk holds.
  std::optional<std::string> read(const std::string& path) override;
  Message obstacle(const std::string& path) override;
  std::string identity(const std::string& path) override;

  std::map<std::string, Document>& documents() { return documents_; }
  const std::map<std::string, Document>& documents() const { return documents_; }
  /// Null where it is not open.
  Document* find(const std::string& uri);

  /// The findings of a document, which notes what files they were made from.
  std::vector<Diagnostic> check(Document& document);
  /// The same without a note.
  std::vector<Diagnostic> check(const Document& document) const;

  /// The options, with all open structured programs and those given.
  LanguageOptions surroundings(const std::vector<Source>& closed = {}) const;
  /// The programs on the disk that may include a structured program.
  std::vector<Source> closed_programs(const Document& document) const;
  /// Calls `visit` with the path and the text of each file of the open folders that is not open.
  void each_closed_file(const std::function<void(const std::string&, std::string)>& visit) const;
  /// A program's file is named by its path; an open text by its URI.
  std::string uri_of(const Source& source) const;

  LanguageOptions options;
  Say say;
  std::vector<std::string> roots; ///< the paths of the folders that the editor has open

private:
  structured::Files* disk_;
  Folders* folders_;
  std::set<std::string>* reads_ = nullptr; ///< where `read` notes what it is asked for
  std::map<std::string, Document> documents_;
};

/// A finding as the protocol has it.
Json diagnostic(const Workspace& space, const std::string& uri, const Document& document,
                const Diagnostic& one);

} // namespace orb::editor
