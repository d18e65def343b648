#include "app/features/survey/SurveyModel.h"

#include "app/base/filePath.h"
#include "base/oneLine.h"
#include "base/utc.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"

#include <QBrush>
#include <QPalette>

#include <algorithm>
#include <functional>
#include <utility>

namespace faintline {

namespace {

    constexpr std::chrono::milliseconds patience(1000); ///< the window is blocked meanwhile

    QString verdictText(Verdict verdict)
    {
        switch (verdict) {
        case Verdict::Accepted:
            return SurveyModel::tr("accepted");
        case Verdict::Rejected:
            return SurveyModel::tr("rejected");
        case Verdict::None:
            break;
        }
        return {};
    }

} // namespace

SurveyModel::SurveyModel(QObject *parent) : ColumnModel(parent)
{
    layColumns();
}

/// All numbers of a column in one unit.
void SurveyModel::layColumns()
{
    double last = 0.0;
    for (const Row &row : m_content.rows)
        last = std::max(last, row.event.event.endSeconds);
    const ColumnTimes times(last, 0.01);
    const auto number = [this](const QString &heading, double (*value)(const Event &),
                               const std::function<QString(double)> &text) {
        const auto of = [this, value](int i) { return value(row(i).event.event); };
        return ShownColumn<int>{.heading = heading, .text = [of, text](int i) { return text(of(i)); }, .key = of};
    };
    const auto seconds = [times](double value) { return times.text(value); };
    using E = const Event &;
    std::vector<ShownColumn<int>> columns{
        {.heading = tr("Recording"),
         .text =
             [this](int i) {
                 return labelText(storedPath(recordings()[row(i).recording].file.path, pathBytes(path())), longestPath);
             },
         .key = [this](int i) { return double(row(i).recording); },
         .alignment = Qt::AlignLeft},
        number(
            times.heading(tr("Onset")), [](E event) { return event.onsetSeconds; }, seconds),
        number(
            times.heading(tr("Duration")), [](E event) { return event.endSeconds - event.onsetSeconds; }, seconds),
        number(
            tr("f (Hz)"), [](E event) { return event.position.back(); }, [](double hz) { return numberText(hz, 2); }),
        number(
            tr("Drift (Hz/s)"), [](E event) { return event.driftPerSecond; },
            [](double rate) { return powerText(rate, 3); }),
        number(
            tr("Statistic"), [](E event) { return event.statistic; },
            [](double value) { return numberText(value, 1); }),
        {.heading = tr("Review"),
         .text = [this](int i) { return verdictText(row(i).event.box.verdict); },
         .key = [this](int i) { return double(row(i).event.box.verdict); },
         .alignment = Qt::AlignLeft},
        {.heading = tr("Note"),
         .text = [this](int i) { return QString::fromStdString(oneLine(row(i).event.box.note)); },
         .alignment = Qt::AlignLeft}};
    for (ShownColumn<int> &column : columns) {
        column.colour = [this](int i) {
            return row(i).event.box.verdict == Verdict::Rejected
                       ? QVariant(QPalette().brush(QPalette::Disabled, QPalette::Text))
                       : QVariant();
        };
        column.cellTip = [this](int i) {
            const auto start = recordings()[row(i).recording].startUnixSeconds;
            return start ? QVariant(QString::fromStdString(formatUtc(*start + row(i).event.event.onsetSeconds)))
                         : QVariant();
        };
    }
    setColumns(std::move(columns));
}

SurveyModel::Content SurveyModel::read(const QString &path, const RunContext &context)
{
    SurveyDatabase survey(pathBytes(path), Sqlite::Access::Read, patience);
    survey.hold();
    Content content{path, settingsOf(survey.origin(), survey.path()), survey.recordings(), {}};
    for (std::size_t i = 0; i < content.recordings.size(); ++i) {
        context.checkpoint(double(i) / double(content.recordings.size()), "reading the survey");
        for (SurveyEvent &event : survey.events(content.recordings[i].id))
            content.rows.push_back({i, std::move(event)});
    }
    return content;
}

void SurveyModel::show(Content content)
{
    beginResetModel();
    m_content = std::move(content);
    setRowCount(int(m_content.rows.size()));
    layColumns();
    endResetModel();
}

void SurveyModel::judge(const std::vector<int> &rows, Verdict verdict)
{
    if (rows.empty())
        return;
    SurveyDatabase survey(pathBytes(path()), Sqlite::Access::Write, patience);
    survey.begin();
    for (const int number : rows) {
        const Row &one = row(number);
        survey.setReview(recordings()[one.recording].file.path, one.event.event, verdict, one.event.box.note);
    }
    survey.commit();
    for (const int number : rows)
        m_content.rows[std::size_t(number)].event.box.verdict = verdict;
    const auto [first, last] = std::minmax_element(rows.begin(), rows.end());
    emit dataChanged(index(*first, 0), index(*last, ColumnCount - 1));
}

} // namespace faintline
