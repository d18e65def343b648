#include "app/panels/experimentWords.h"

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

    QString wordsOf(const LineExperiment &lines)
    {
        return QObject::tr("%1 runs, %2 dB, %3 T_FT, seed %4")
            .arg(lines.runs)
            .arg(spanOf(lines.snrDb), number(lines.durationWindows))
            .arg(lines.seed);
    }

    QString wordsOf(const InjectionExperiment &injection)
    {
        return QObject::tr("%1 trials, %2 dB, %3 s, seed %4")
            .arg(injection.trials)
            .arg(spanOf(injection.snrDb), number(injection.durationSeconds))
            .arg(injection.seed);
    }

    QString wordsOf(const SweepExperiment &sweep)
    {
        return QObject::tr("%1 = %2, %3 trials, %4 dB, %5 s, seed %6")
            .arg(QString::fromStdString(sweep.parameter), spanOf(sweep.values))
            .arg(sweep.trials)
            .arg(number(sweep.snrDb), number(sweep.durationSeconds))
            .arg(sweep.seed);
    }

} // namespace

QString experimentWords(const Experiment &experiment)
{
    return std::visit([](const auto &one) { return wordsOf(one); }, experiment);
}

} // namespace faintline
