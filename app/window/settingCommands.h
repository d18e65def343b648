#pragma once

#include <functional>

class QMenu;

namespace faintline {

class SettingsForm;

/// Replaces the entries of a menu: one for each setting that the form offers now, "Signal model: Slopes per bin". An
/// entry calls `show`, which brings the form into view, and goes to its setting.
void listSettings(QMenu &menu, SettingsForm &form, const std::function<void()> &show);

} // namespace faintline
