#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace pastefit::browser {

// What a page in a browser calls: a name and a request in JSON, an answer in JSON. Each function throws `Refusal` for
// input that it cannot use, and nlohmann::json::exception for a request of another form.

/// {"version", "engine", "kernels"}
nlohmann::ordered_json version();

/// Moulds that a sheet may name: [{"name", "title", "test", "drops", "caution", "apparatus"}, ...]
nlohmann::ordered_json presets();

/// The starting files of a sheet, {"lab", "study", "notes"}, from the options of `pastefit new` as keys: "mould",
/// "density", "slump", "spread", ..., "sd", "fix" and "prior" as objects of texts, "confirm" as a list.
nlohmann::ordered_json new_files(const nlohmann::json& request);

/// {"files": [{"name", "text"}, ...], "notes"} of {"card", "target", "test", "unconfirmed"}: as `pastefit export`.
nlohmann::ordered_json exported(const nlohmann::json& request);

/// The answer to a call: {"ok": ANSWER} or {"faults": [{"where", "what", "remedy"}, ...]}, as text. The module holds
/// one calibration at most, from "open" on. Throws nothing.
std::string answer_to_call(const std::string& name, const std::string& request);

}  // namespace pastefit::browser
