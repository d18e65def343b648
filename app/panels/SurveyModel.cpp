#include "app/panels/SurveyModel.h"

#include "app/base/filePath.h"
#include "base/oneLine.h"
#include "base/utc.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"

#include <QBrush>
#include <QPalette>

#include <algorithm>

namespace faintline {

namespace {

    constexpr std::chrono::milliseconds patience(1000); ///< the window waits meanwhile

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

void SurveyModel::read(const QString &path)
{
    SurveyDatabase survey(pathBytes(path), Sqlite::Access::Read, patience);
    survey.hold();
    const SurveySettings settings = settingsOf(survey.origin(), survey.path());
    std::vector<SurveyRecording> recordings = survey.recordings();
    std::vector<Row> rows;
    for (std::size_t i = 0; i < recordings.size(); ++i)
        for (SurveyEvent &event : survey.events(recordings[i].id))
            rows.push_back({i, std::move(event)});
    beginResetModel();
    m_path = path;
    m_settings = settings;
    m_recordings = std::move(recordings);
    m_rows = std::move(rows);
    endResetModel();
}

void SurveyModel::judge(const std::vector<int> &rows, Verdict verdict)
{
    if (rows.empty())
        return;
    SurveyDatabase survey(pathBytes(m_path), Sqlite::Access::Write, patience);
    survey.begin();
    for (const int number : rows) {
        const Row &one = row(number);
        survey.setReview(m_recordings[one.recording].file.path, one.event.event, verdict, one.event.box.note);
    }
    survey.commit();
    for (const int number : rows)
        m_rows[std::size_t(number)].event.box.verdict = verdict;
    const auto [first, last] = std::minmax_element(rows.begin(), rows.end());
    emit dataChanged(index(*first, 0), index(*last, ColumnCount - 1));
}

QString SurveyModel::text(const Row &row, int column) const
{
    const Event &event = row.event.event;
    constexpr double resolution = 0.01;
    switch (column) {
    case Recording:
        return labelText(storedPath(m_recordings[row.recording].file.path, pathBytes(m_path)));
    case Onset:
        return secondsText(event.onsetSeconds, resolution);
    case Duration:
        return secondsText(event.endSeconds - event.onsetSeconds, resolution);
    case Frequency:
        return hertzText(event.position.back(), resolution);
    case Drift:
        return rateText(event.driftPerSecond);
    case Statistic:
        return numberText(event.statistic, 1);
    case Review:
        return verdictText(row.event.box.verdict);
    default:
        return QString::fromStdString(oneLine(row.event.box.note));
    }
}

QVariant SurveyModel::sortKey(const Row &row, int column) const
{
    const Event &event = row.event.event;
    switch (column) {
    case Recording:
        return qulonglong(row.recording);
    case Onset:
        return event.onsetSeconds;
    case Duration:
        return event.endSeconds - event.onsetSeconds;
    case Frequency:
        return event.position.back();
    case Drift:
        return event.driftPerSecond;
    case Statistic:
        return event.statistic;
    default:
        return text(row, column);
    }
}

QVariant SurveyModel::data(const QModelIndex &index, int role) const
{
    const Row &one = row(index.row());
    switch (role) {
    case Qt::DisplayRole:
        return text(one, index.column());
    case Qt::UserRole:
        return sortKey(one, index.column());
    case Qt::TextAlignmentRole:
        return int(Qt::AlignVCenter
                   | (index.column() >= Onset && index.column() <= Statistic ? Qt::AlignRight : Qt::AlignLeft));
    case Qt::ForegroundRole:
        return one.event.box.verdict == Verdict::Rejected
                   ? QVariant(QPalette().brush(QPalette::Disabled, QPalette::Text))
                   : QVariant();
    case Qt::ToolTipRole:
        if (const auto start = m_recordings[one.recording].startUnixSeconds)
            return QString::fromStdString(formatUtc(*start + one.event.event.onsetSeconds));
        return {};
    default:
        return {};
    }
}

QVariant SurveyModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole)
        return {};
    switch (section) {
    case Recording:
        return tr("Recording");
    case Onset:
        return tr("Onset");
    case Duration:
        return tr("Duration");
    case Frequency:
        return tr("Frequency");
    case Drift:
        return tr("Drift");
    case Statistic:
        return tr("Statistic");
    case Review:
        return tr("Review");
    default:
        return tr("Note");
    }
}

} // namespace faintline
