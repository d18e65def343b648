#include "app/features/opening/OpenOptionsDialog.h"

#include "app/base/filePath.h"
#include "app/document/rawFields.h"
#include "signal/formats/RawRecording.h"
#include "signal/formats/SampleType.h"
#include "signal/openRecording.h"
#include "widgets/base/labelText.h"

#include <QDialogButtonBox>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace faintline {

namespace {

    /// Type and rate as a receiver's program wrote them into the name, else the type of the extension.
    OpenOptions suggested(const QString &path)
    {
        OpenOptions options = withNamedFormat(pathBytes(path), {});
        if (options.rawType.empty())
            options.rawType = rawTypeOfExtension(pathBytes(path)).value_or("");
        if (options.rawType.empty())
            options.rawType = "ci16_le";
        if (!(options.rawRateHz > 0.0))
            options.rawRateHz = 48000.0;
        return options;
    }

    bool takesPairs(const OpenOptions &options)
    {
        return !parseSampleType(options.rawType, "type").isComplex && options.rawChannels % 2 == 0;
    }

} // namespace

OpenOptionsDialog::OpenOptionsDialog(const QString &path, QWidget *parent)
    : QDialog(parent), m_fileBytes(fileSize(path)),
      m_form(new FieldForm<OpenOptions>(tr("Format"), rawFields(), suggested(path))), m_length(plainLabel()),
      m_buttons(new QDialogButtonBox(QDialogButtonBox::Open | QDialogButtonBox::Cancel))
{
    setWindowTitle(tr("Raw samples"));
    connect(m_buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(m_buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto *layout = new QVBoxLayout(this);
    layout->addWidget(new QLabel(
        tr("<b>%1</b> holds samples without a header. Specify their format.").arg(fileLabel(path).toHtmlEscaped())));
    layout->addWidget(m_form);
    layout->addWidget(m_length);
    layout->addWidget(m_buttons);
    m_form->setTracking(true);
    connect(m_form, &FieldFormBase::edited, this, &OpenOptionsDialog::showLength);
    showLength();
}

OpenOptions OpenOptionsDialog::options() const
{
    OpenOptions options = m_form->value();
    options.iq = options.iq && takesPairs(options);
    return options;
}

void OpenOptionsDialog::showLength()
{
    const OpenOptions options = this->options();
    const Index sampleBytes = parseSampleType(options.rawType, "type").sampleBytes() * options.rawChannels;
    const Index samples = (m_fileBytes - options.rawHeaderBytes) / sampleBytes;
    m_length->setText(m_form->isRefused() ? tr("Length unknown")
                      : samples > 0       ? tr("Length %1 s").arg(double(samples) / options.rawRateHz, 0, 'g', 6)
                                          : tr("No sample: the file has %1 bytes").arg(m_fileBytes));
    m_form->editor(QStringLiteral("iq"))->setEnabled(takesPairs(options));
    m_buttons->button(QDialogButtonBox::Open)->setEnabled(!m_form->isRefused() && samples > 0);
}

} // namespace faintline
