#include "app/features/evaluate/experimentWords.h"

#include <QObject>

#include <algorithm>

namespace faintline {

namespace {

    QString number(double value)
    {
        return QString::number(value, 'g', 6);
    }

    QString spanOf(const std::vector<double> &values)
    {
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        return *low == *high ? number(*low) : number(*low) + QStringLiteral(" … ") + number(*high);
    }

} // namespace

QString experimentWords(const Experiment &experiment)
{
    const QString values =
        experiment.isSweep()
            ? QStringLiteral("%1 = %2, ").arg(QString::fromStdString(experiment.parameter), spanOf(experiment.values))
            : QString();
    return values
           + QObject::tr("%1 %2, %3 dB, %4 %5, seed %6")
                 .arg(experiment.trials)
                 .arg(experiment.isLines() ? QObject::tr("runs") : QObject::tr("trials"), spanOf(experiment.snrDb),
                      number(experiment.durationSeconds), experiment.isLines() ? "T_FT" : "s")
                 .arg(experiment.seed);
}

} // namespace faintline
