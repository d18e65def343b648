#pragma once

#include "app/base/JobRunner.h"
#include "app/base/Panel.h"
#include "app/document/AnalysisController.h"
#include "app/features/survey/SurveyModel.h"

#include <QHash>

class QBoxLayout;
class QLabel;
class QPushButton;

namespace faintline {

class ColumnTable;

/// The events of a survey of many recordings (faintline-cli survey): one table for all of them; a double-click opens
/// the recording at the event. Reviews are written to the survey's file immediately.
class SurveyPanel : public Panel
{
    Q_OBJECT

public:
    SurveyPanel(const Document &document, const AnalysisController &controller, QWidget *parent = nullptr);

    /// Reads a survey file in the background, then shows it; ends with `opened` or `failed`.
    void open(const QString &path);
    JobRunner &runner() { return m_runner; }
    /// Whether a file is opened by this panel, according to its name or its header.
    static bool isSurvey(const QString &path);

    ColumnTable *table() const { return m_table; }
    /// Writes a verdict for the selected events into the survey.
    void judge(Verdict verdict);

    QSize sizeHint() const override { return {720, 240}; }

signals:
    void opened();
    /// Requests opening a recording with the settings of the survey.
    void openRequested(const QString &path, const faintline::OpenOptions &options,
                       const faintline::AnalysisController::Adjust &adjust);
    /// The recording is open and analysed; `id` is the requested event.
    void eventReached(int id);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void show(SurveyModel::Content content);
    void addVerdict(QBoxLayout &layout, const QString &text, const QString &tip, Qt::Key key, Verdict verdict);
    void activate(const QModelIndex &index);
    void reach();
    void followSelection();

    const Document &m_document;
    SurveyModel *m_model;
    ColumnTable *m_table;
    QLabel *m_summary;
    QList<QPushButton *> m_buttons;
    QHash<int, Verdict> m_keys;

    /// The requested event while its recording is opened and analysed.
    struct {
        QString path;
        int event = 0;
    } m_wanted;

    JobRunner m_runner{this}; ///< last, so that its job ends first
};

} // namespace faintline
