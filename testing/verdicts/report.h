#pragma once

#include "testing/results.h"
#include "testing/suite.h"
#include "testing/verdicts/render.h"

#include <map>
#include <string>
#include <string_view>

namespace orb::testing {

/// Where the files of a report go.
class Pages {
public:
  virtual ~Pages() = default;
  /// Writes a file, its name counting from the report's folder; false ends the report.
  virtual bool write(const std::string& name, std::string_view text) = 0;
};

/// What the index of a report begins with, so that it is known for one.
extern const std::string_view report_mark;

/// Writes a picture of each run, the replay of each failure, and last the page that shows them all:
/// `index.html`. Of a great many runs the first have pictures, and those that failed. Runs that are
/// shown are run once more. Where several programs were tested, each has a page to hand back, in
/// `pupils/`, headed by its name in `names`; `certificates.html` is for those that passed.
bool write_report(const Suite& suite, const Results& results, Pages& pages,
                  const std::map<std::string, std::string>& names = {}, const Speech& speech = {});

} // namespace orb::testing
