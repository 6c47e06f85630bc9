#pragma once

// The names of a structured program, and where each of them stands.

#include "editor/language.h"
#include "structured/compile.h"
#include "structured/meaning/symbols.h"
#include "structured/text/program.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::editor {

inline constexpr std::string_view structured_language_id = "orbstructured";

/// A program with all that it includes.
struct Reading {
  structured::Program program;
  structured::Names names;
  std::vector<std::shared_ptr<const Source>> sources; ///< of its files

  /// The file and the place in it; nothing for what stands in no file, such as a macro's name.
  std::optional<FarPlace> place(Span span) const;
};

Reading read_structured(const Source& source, const LanguageOptions& options);

structured::Compiled compile_structured(const Source& source, const LanguageOptions& options);

/// What a name stands for: a symbol, or a label of a routine.
struct Meaning {
  std::uint32_t symbol = structured::none;
  std::uint32_t routine = structured::none; ///< of a label
  std::uint32_t name = structured::none;    ///< of a label

  friend bool operator==(const Meaning&, const Meaning&) = default;
};

struct NameUse {
  Meaning meaning;
  Span span;
  bool is_set = false;  ///< declared or assigned
  bool defines = false; ///< declared; of a variable without a declaration: assigned
};

/// What a comment in the line above a declaration says, without its mark; may be empty.
std::string comment_above(const Reading& reading, Span declared);

/// Every name of the program, by where it stands in the text of all its files.
std::vector<NameUse> name_uses(const Reading& reading);

} // namespace orb::editor
