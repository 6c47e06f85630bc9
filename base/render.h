#pragma once

#include "base/diagnostic.h"
#include "base/style.h"

#include <functional>
#include <string>

namespace orb {

/// Makes a sentence of a message, in the language of whoever reads it (base/catalogue.h).
using Say = std::function<std::string(const Message&)>;

/// What a finding says, in a line: what was seen, and what helps.
std::string in_one_line(const Diagnostic& diagnostic);

/// One finding as people read it: a gcc-shaped line, the excerpt with a caret, help and notes.
std::string render_text(const Source& source, const Diagnostic& diagnostic, Style style,
                        const Say& say = &in_english);

/// One finding as compilers print it, on a line each with its notes: `F:L:C: error: text [rule]`.
std::string render_gcc(const Source& source, const Diagnostic& diagnostic);

/// The closing line of the text form: `2 errors, 1 warning in 3 files`.
std::string render_summary(const std::vector<FileFindings>& files, const Say& say = &in_english);

/// All findings as one JSON document of schema `orb.check/1` (docs/findings.md).
std::string render_json(const std::vector<FileFindings>& files, const Say& say = &in_english);

/// Where a rule is explained: an address, or empty.
using HelpUri = std::function<std::string(const Rule&)>;

/// All findings as one SARIF 2.1.0 log. Columns count code points; bytes that are not UTF-8 appear
/// as U+FFFD. A finding keeps its fingerprint when lines above it come and go.
std::string render_sarif(const std::vector<FileFindings>& files, const HelpUri& help_uri = {});

} // namespace orb
