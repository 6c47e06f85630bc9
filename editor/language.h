#pragma once

// What an editor may ask about a text, independent of any protocol: places are bytes in a Source.
// editor/languages/ has the answers, one folder per language (*_language.cpp).

#include "base/diagnostic.h"
#include "base/source.h"
#include "spec/basic.h"
#include "structured/text/files.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace orb::editor {

/// The target of checks, and the surrounding files.
struct LanguageOptions {
  spec::BasicVersion target = spec::default_basic_version;
  structured::Files* files = nullptr; ///< reads included files; null: none can be read
  std::vector<const Source*> open;    ///< open structured programs, which may include each other
};

struct Hover {
  Span span;
  std::string markdown;
};

enum class SuggestionKind : std::uint8_t { Keyword, Function, Variable, Value, Line, Rule, Name };

struct Suggestion {
  std::string label;
  SuggestionKind kind = SuggestionKind::Keyword;
  std::string detail;   ///< shown next to the label
  std::string markdown; ///< shown for the selected suggestion
};

struct Suggestions {
  Span replaces; ///< the part already typed
  std::vector<Suggestion> items;
};

enum class OutlineKind : std::uint8_t { Function, Constant, Array };

/// An entry of the outline: a subroutine, a macro.
struct Symbol {
  std::string name;
  std::string detail;
  Span span;      ///< the whole definition
  Span selection; ///< its name
  OutlineKind kind = OutlineKind::Function;
};

/// A place in a file that the text includes, or that includes the text.
struct FarPlace {
  std::shared_ptr<const Source> source; ///< its name is a path, or that of an open text
  Span span;
  bool defines = false;
};

/// The places of a name: a line number, a variable, a macro.
struct Occurrences {
  std::vector<Span> definitions;
  std::vector<Span> uses;
  std::vector<FarPlace> elsewhere;
};

/// A renaming: edits in the text, and places in other files.
struct Renaming {
  std::vector<Edit> edits;
  std::vector<FarPlace> elsewhere;
};

/// A change of the whole text that a user can choose.
struct Rewrite {
  std::string title;
  std::string kind; ///< in the protocol: `source.renumber`
  std::string text;
};

/// A short text shown after a place, with its tooltip.
struct Hint {
  std::uint32_t at = 0;
  std::string label;
  std::string tooltip;
};

struct LanguageShape; // editor/languages/shape.h

/// The service of one language. Every function is pure and accepts any text, however broken.
struct LanguageService {
  std::vector<Diagnostic> (*check)(const Source& source, const LanguageOptions& options);
  std::optional<Hover> (*hover)(const Source& source, std::uint32_t offset,
                                const LanguageOptions& options);
  Suggestions (*suggest)(const Source& source, std::uint32_t offset,
                         const LanguageOptions& options);
  std::vector<Symbol> (*outline)(const Source& source);
  /// Finds every place of the name at `offset`.
  Occurrences (*occurrences)(const Source& source, std::uint32_t offset,
                             const LanguageOptions& options);
  /// Renames the name at `offset`, or says why that is impossible.
  tl::expected<Renaming, std::string> (*rename)(const Source& source, std::uint32_t offset,
                                                std::string_view name,
                                                const LanguageOptions& options);
  /// Returns the text in canonical layout; nothing if it cannot be formatted.
  std::optional<std::string> (*format)(const Source& source);
  /// Returns only rewrites that change something.
  std::vector<Rewrite> (*rewrites)(const Source& source, const LanguageOptions& options);
  const LanguageShape* shape = nullptr;
  /// Returns hints in order of the text; null for a language without hints.
  std::vector<Hint> (*hints)(const Source& source, const LanguageOptions& options) = nullptr;
};

/// The answers of a language without the feature.
namespace nothing {
Occurrences occurrences(const Source& source, std::uint32_t offset, const LanguageOptions& options);
std::vector<Rewrite> rewrites(const Source& source, const LanguageOptions& options);
} // namespace nothing

extern const LanguageService basic_service;
extern const LanguageService structured_service;
extern const LanguageService macro_service;
extern const LanguageService test_service;
extern const LanguageService stimulus_service;

} // namespace orb::editor
