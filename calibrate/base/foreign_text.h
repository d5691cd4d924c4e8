#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace pastefit {

/// Texts that somebody else wrote (a title, a note, the name of a file), made fit for the place they are written to.
/// Every such text goes through the function of its target. All of them answer with valid UTF-8, in which bytes that
/// are none are U+FFFD, and control characters, which could drive a terminal or turn the order of its letters round,
/// are spaces.

/// For people, as part of a line.
std::string one_line(std::string_view text);

/// For people, as it is: line breaks and tabs stay.
std::string lines_of(std::string_view text);

/// A comment of one line, "# ...\n", in the decks of LAMMPS and LIGGGHTS and in a Python module: what their readers
/// look for in comments too (quotation marks, variables, continued lines) is replaced. Python reads its encoding from
/// comments of the first two lines: such a comment has to stand further down.
std::string deck_comment(std::string_view text);

/// Content or an attribute of XML; a line break in it is a character reference.
std::string xml_text(std::string_view text);

/// JSON with indentation, ending with a line break; control characters are escaped.
std::string json_text(const nlohmann::ordered_json& value);

/// JSON on one line to stand in an element of HTML, a script's too: no text in it can end the element or begin another,
/// because "<", ">" and "&" are written as escapes, like all that is not ASCII.
std::string json_in_html(const nlohmann::ordered_json& value);

}  // namespace pastefit
