#pragma once

namespace pastefit {

inline constexpr double mm = 1000;  ///< millimetres in a metre

}  // namespace pastefit
