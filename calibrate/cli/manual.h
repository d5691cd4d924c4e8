#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace pastefit {

// Manual and completion, made from the command line's own definitions, so that they say what the program does.

/// The page of a verb, or of the program itself, for man(1), section 1.
std::string man_page_of(const CLI::App& app);

/// Completes verbs, options and files. Requirement: `shell` is one of `completed_shells`.
std::string completion_of(const CLI::App& program, std::string_view shell);
inline constexpr std::string_view completed_shells[] = {"bash", "zsh", "fish"};

/// The verbs of a program, in the order of its table.
std::vector<const CLI::App*> verbs_of(const CLI::App& program);

}  // namespace pastefit
