#include "app/panels/SurveyModel.h"

#include "app/base/filePath.h"
#include "base/oneLine.h"
#include "base/utc.h"
#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"

#include <QBrush>
#include <QPalette>

#include <algorithm>
#include <numeric>
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

    /// Sort key of a column, except for the notes.
    double sortKey(const SurveyModel::Row &row, int column)
    {
        const Event &event = row.event.event;
        switch (column) {
        case SurveyModel::Recording:
            return double(row.recording);
        case SurveyModel::Onset:
            return event.onsetSeconds;
        case SurveyModel::Duration:
            return event.endSeconds - event.onsetSeconds;
        case SurveyModel::Frequency:
            return event.position.back();
        case SurveyModel::Drift:
            return event.driftPerSecond;
        case SurveyModel::Statistic:
            return event.statistic;
        default:
            return double(row.event.box.verdict);
        }
    }

    bool isBefore(const SurveyModel::Row &a, const SurveyModel::Row &b, int column)
    {
        return column == SurveyModel::Note ? a.event.box.note < b.event.box.note
                                           : sortKey(a, column) < sortKey(b, column);
    }

} // namespace

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
    m_order.resize(m_content.rows.size());
    std::iota(m_order.begin(), m_order.end(), std::size_t(0));
    arrange();
    endResetModel();
}

void SurveyModel::arrange()
{
    std::stable_sort(m_order.begin(), m_order.end(), [this](std::size_t a, std::size_t b) {
        if (m_sortOrder == Qt::DescendingOrder)
            std::swap(a, b);
        return isBefore(m_content.rows[a], m_content.rows[b], m_sortColumn);
    });
}

void SurveyModel::sort(int column, Qt::SortOrder order)
{
    m_sortColumn = column;
    m_sortOrder = order;
    emit layoutAboutToBeChanged();
    const std::vector<std::size_t> before = m_order;
    arrange();
    std::vector<int> places(m_order.size());
    for (std::size_t i = 0; i < m_order.size(); ++i)
        places[m_order[i]] = int(i);
    QModelIndexList moved; // keeps the selection
    for (const QModelIndex &one : persistentIndexList())
        moved << index(places[before[std::size_t(one.row())]], one.column());
    changePersistentIndexList(persistentIndexList(), moved);
    emit layoutChanged();
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
        m_content.rows[m_order[std::size_t(number)]].event.box.verdict = verdict;
    const auto [first, last] = std::minmax_element(rows.begin(), rows.end());
    emit dataChanged(index(*first, 0), index(*last, ColumnCount - 1));
}

QString SurveyModel::text(const Row &row, int column) const
{
    const Event &event = row.event.event;
    constexpr double resolution = 0.01;
    switch (column) {
    case Recording:
        return labelText(storedPath(recordings()[row.recording].file.path, pathBytes(path())));
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

QVariant SurveyModel::data(const QModelIndex &index, int role) const
{
    const Row &one = row(index.row());
    switch (role) {
    case Qt::DisplayRole:
        return text(one, index.column());
    case Qt::TextAlignmentRole:
        return int(Qt::AlignVCenter
                   | (index.column() >= Onset && index.column() <= Statistic ? Qt::AlignRight : Qt::AlignLeft));
    case Qt::ForegroundRole:
        return one.event.box.verdict == Verdict::Rejected
                   ? QVariant(QPalette().brush(QPalette::Disabled, QPalette::Text))
                   : QVariant();
    case Qt::ToolTipRole:
        if (const auto start = recordings()[one.recording].startUnixSeconds)
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
