#pragma once

#include "exchange/survey/SurveyDatabase.h"

#include <QAbstractTableModel>

#include <vector>

namespace faintline {

/// The events of a survey as a table: recording, time, position, statistic, review.
class SurveyModel : public QAbstractTableModel
{
    Q_OBJECT

public:
    enum Column { Recording, Onset, Duration, Frequency, Drift, Statistic, Review, Note, ColumnCount };

    struct Row {
        std::size_t recording; ///< index in `recordings`
        SurveyEvent event;
    };

    using QAbstractTableModel::QAbstractTableModel;

    /// Reads everything. Throws Error; then the table stays as it was.
    void read(const QString &path);
    /// Writes a verdict into the file, or nothing where one of the events is not there any more. Throws Error.
    void judge(const std::vector<int> &rows, Verdict verdict);

    const QString &path() const { return m_path; }
    const SurveySettings &settings() const { return m_settings; }
    const std::vector<SurveyRecording> &recordings() const { return m_recordings; }
    const Row &row(int number) const { return m_rows[std::size_t(number)]; }

    int rowCount(const QModelIndex &parent = {}) const override { return parent.isValid() ? 0 : int(m_rows.size()); }
    int columnCount(const QModelIndex & = {}) const override { return ColumnCount; }
    /// Qt::UserRole: what a column is sorted by.
    QVariant data(const QModelIndex &index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    QString text(const Row &row, int column) const;
    QVariant sortKey(const Row &row, int column) const;

    QString m_path;
    SurveySettings m_settings;
    std::vector<SurveyRecording> m_recordings;
    std::vector<Row> m_rows;
};

} // namespace faintline
