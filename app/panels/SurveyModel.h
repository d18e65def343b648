#pragma once

#include "base/RunContext.h"
#include "exchange/survey/SurveyDatabase.h"

#include <QAbstractTableModel>

#include <vector>

namespace faintline {

/// Table model of a survey's events: recording, time, position, statistic, review. Rows are sorted by a column.
class SurveyModel : public QAbstractTableModel
{
    Q_OBJECT

public:
    enum Column { Recording, Onset, Duration, Frequency, Drift, Statistic, Review, Note, ColumnCount };

    struct Row {
        std::size_t recording; ///< index in `recordings`
        SurveyEvent event;
    };

    /// Everything read from a survey.
    struct Content {
        QString path;
        SurveySettings settings;
        std::vector<SurveyRecording> recordings;
        std::vector<Row> rows; ///< in the order of the file
    };

    using QAbstractTableModel::QAbstractTableModel;

    /// Reads a survey, on any thread. Throws Error and Cancelled.
    static Content read(const QString &path, const RunContext &context = {});
    void show(Content content);
    /// Writes a verdict to the file, or nothing if one of the events no longer exists. Throws Error.
    void judge(const std::vector<int> &rows, Verdict verdict);

    const QString &path() const { return m_content.path; }
    const SurveySettings &settings() const { return m_content.settings; }
    const std::vector<SurveyRecording> &recordings() const { return m_content.recordings; }
    const Row &row(int number) const { return m_content.rows[m_order[std::size_t(number)]]; }

    int rowCount(const QModelIndex &parent = {}) const override { return parent.isValid() ? 0 : int(m_order.size()); }
    int columnCount(const QModelIndex & = {}) const override { return ColumnCount; }
    QVariant data(const QModelIndex &index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    void sort(int column, Qt::SortOrder order) override;

private:
    QString text(const Row &row, int column) const;
    void arrange();

    Content m_content;
    std::vector<std::size_t> m_order; ///< indices of the displayed rows in the content
    int m_sortColumn = Recording;
    Qt::SortOrder m_sortOrder = Qt::AscendingOrder;
};

} // namespace faintline
