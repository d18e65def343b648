#pragma once

#include "base/RunContext.h"
#include "exchange/survey/SurveyDatabase.h"

#include "widgets/table/ColumnModel.h"

#include <vector>

namespace faintline {

/// Table model of a survey's events: recording, time, position, statistic, review.
class SurveyModel : public ColumnModel
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

    explicit SurveyModel(QObject *parent = nullptr);

    /// Reads a survey, on any thread. Throws Error and Cancelled.
    static Content read(const QString &path, const RunContext &context = {});
    void show(Content content);
    /// Writes a verdict to the file, or nothing if one of the events no longer exists. Throws Error.
    void judge(const std::vector<int> &rows, Verdict verdict);

    const QString &path() const { return m_content.path; }
    const SurveySettings &settings() const { return m_content.settings; }
    const std::vector<SurveyRecording> &recordings() const { return m_content.recordings; }
    const Row &row(int number) const { return m_content.rows[std::size_t(number)]; }

private:
    void layColumns();

    Content m_content;
};

} // namespace faintline
