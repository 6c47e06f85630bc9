#pragma once

#include "uploader/device_words.h"

#include <CLI/CLI.hpp>
#include <string>
#include <utility>

namespace orb::cli {

/// Help with the examples first: people paste before they read.
class HelpFormatter : public CLI::Formatter {
public:
  explicit HelpFormatter(std::string examples)
      : examples_(uploader::with_ports_of_this_system(std::move(examples))) {}

  std::string make_description(const CLI::App* app) const override;

  const std::string& examples() const { return examples_; }

private:
  std::string examples_;
};

} // namespace orb::cli
