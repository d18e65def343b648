#include "app/window/settingCommands.h"

#include "widgets/base/settingWords.h"
#include "widgets/forms/SettingsForm.h"

#include <QMenu>

namespace faintline {

void listSettings(QMenu &menu, SettingsForm &form, const std::function<void()> &show)
{
    menu.clear();
    for (const auto &field : AnalysisSettings::fields()) {
        const QString name = QString::fromStdString(field.name);
        if (!form.isOffered(name))
            continue;
        const QString stage = stageLabel(name.section(QLatin1Char('.'), 0, 0));
        menu.addAction(QStringLiteral("%1: %2").arg(stage, settingLabel(name)), [&form, show, name] {
            show();
            form.reveal(name);
        });
    }
}

} // namespace faintline
